"""Scenes made in Python say the same as files do, mistakes included."""

import pathlib

import numpy as np
import pytest

import wrinkle
from conftest import DATA


def test_a_scene_of_layers_is_the_toml_that_says_the_same(tmp_path):
    scene = wrinkle.Scene(
        layers=[
            wrinkle.HeightMap(name='quote " and \\', texture=pathlib.Path("cobbles_height.png"), scale=np.float32(0.5),
                              uv=wrinkle.Uv(source="planar", scale=np.array([2, 3])), blend="subtract",
                              mask=wrinkle.Mask(object=7, invert=True)),
            wrinkle.Constant(gradient=(0.75, 0, 5)),
        ],
        lights=[wrinkle.Light("sun", direction=[0, 0, -1])], lighting={"relight": "lit"}, folder=DATA / "textures")
    frame = f'[gbuffer]\nfile = "{DATA}/gbuffer/courtyard.exr"\n'
    (tmp_path / "scene.toml").write_text(frame + scene.toml.replace("cobbles", f"{DATA}/textures/cobbles"),
                                         encoding="utf-8")
    loaded = wrinkle.Scene.load(tmp_path / "scene.toml")
    assert scene.layers == loaded.layers == ['quote " and \\', "constant 2"]


def test_every_kind_of_layer_has_a_class():
    for name, cls in wrinkle.scenes.layer_classes.items():
        assert getattr(wrinkle, name) is cls and name in dir(wrinkle)
        assert f'"{cls().kind}"' in cls.__doc__


@pytest.mark.parametrize("layer, said", [
    (lambda: wrinkle.Noise(frequncy=8), 'did you mean "frequency"'),
    (lambda: wrinkle.Noise(octaves=0), '"octaves"'),
    (lambda: wrinkle.Noise(scale=float("nan")), '"scale"'),
    (lambda: wrinkle.HeightMap(texture="missing.png"), "missing.png"),
    (lambda: wrinkle.Layer("nois"), 'did you mean "noise"'),
    (lambda: wrinkle.Noise(scale=object()), "numbers, texts, lists and tables; found object"),
    (lambda: wrinkle.Constant(gradient=[1, 2]), '"gradient"'),
])
def test_mistakes_are_told_as_those_of_files(layer, said):
    with pytest.raises(wrinkle.Error) as error:
        wrinkle.Scene(layers=[layer()])
    assert said in str(error.value)


def test_replace_leaves_the_layer_as_it_was():
    layer = wrinkle.Noise(frequency=8, scale=0.1)
    assert layer.replace(scale=0.2).scale == 0.2 and layer.scale == 0.1
    assert layer.replace(scale=None) == wrinkle.Noise(frequency=8)
    with pytest.raises(AttributeError):
        layer.octaves


def test_no_such_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="Noise"):
        wrinkle.Nois


def test_explain_tells_what_the_command_does():
    told = wrinkle.explain(wrinkle.Scene.load(DATA / "scenes" / "constant.toml"))
    assert told["inputs"] and told["operations_per_pixel"] > 0
