#!/usr/bin/env python3
"""Draws data/pictures/relit.jpg: the yard relit in some modes beside its re-render, and FLIP maps below.

    bench/picture/relit.py --pictures FOLDER && data/make/relit_figure.py FOLDER      needs what bench/picture/picture_error.py needs
"""
import pathlib
import sys

import flip_evaluator
import numpy as np
import OpenImageIO as oiio

data = pathlib.Path(__file__).resolve().parents[1]
sys.path.append(str(data.parent / "bench" / "picture"))

from picture_error import flip, linear, planes, shown  # noqa: E402

TITLE = 18  # pixels that a title is high
frame = planes(data / "gbuffer" / "yard.exr")
wanted = linear(frame, "Bumped.")


def relit(mode):
    return linear(planes(pathlib.Path(sys.argv[1]) / "yard" / mode / "lit.exr"))


columns = [("unbumped", linear(frame, "ViewLayer.Combined.")), ("fitted lights", relit("fitted_lights")),
           ("shadows read", relit("known_lights_and_sky_shadows_read")), ("light pictures", relit("light_pictures_and_sky")),
           ("re-render", wanted)]
blocks = []
for title, picture in columns:
    again = linear(frame, "BumpedAgain.") if picture is wanted else picture
    error = flip_evaluator.evaluate(shown(wanted), shown(again), "LDR", inputsRGB=True, applyMagma=True)[0]
    name = "rendered, and its other seed" if picture is wanted else title
    text = oiio.ImageBuf(oiio.ImageSpec(picture.shape[1], TITLE, 3, "float"))
    oiio.ImageBufAlgo.fill(text, (1, 1, 1))
    oiio.ImageBufAlgo.render_text(text, 4, TITLE - 5, f"{name}: {flip(again, wanted).mean():.3f}", 13, "", (0, 0, 0))
    blocks.append(np.vstack([text.get_pixels("float"), shown(picture), error]))
figure = np.ascontiguousarray(np.hstack(blocks), dtype=np.float32)
out = oiio.ImageOutput.create(str(data / "pictures" / "relit.jpg"))
spec = oiio.ImageSpec(figure.shape[1], figure.shape[0], 3, "uint8")
spec.attribute("Compression", "jpeg:88")
if not out.open(str(data / "pictures" / "relit.jpg"), spec) or not out.write_image(figure):
    sys.exit(out.geterror())
out.close()
