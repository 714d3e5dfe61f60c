"""Passes: the same bits as the command line, in threads, without growing, interruptible."""

import gc
import pathlib
import resource
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest

import wrinkle
from conftest import DATA, SHAPE


def test_the_normal_is_that_of_the_volume_gradient(gbuffer):
    layer = wrinkle.Constant(gradient=[0.75, 0, 5], mask=wrinkle.Mask(object=7))
    out = wrinkle.evaluate(wrinkle.Scene(layers=[layer], output={"marked": True}), gbuffer)
    assert out["marked"].shape == SHAPE and out["normal"].shape == (*SHAPE, 3)
    assert np.allclose(out["normal"][:, 40], (-0.6, 0, 0.8), atol=1e-6)
    assert (out["normal"][:, 10] == (0, 0, 1)).all()


def test_bits_are_those_of_the_command_line(tmp_path):
    file = DATA / "scenes" / "constant.toml"
    scene = wrinkle.Scene.load(file)
    subprocess.run([sys.executable, "-m", "wrinkle", "run", file, "-o", tmp_path], check=True, capture_output=True)
    written = wrinkle.GBuffer.read(tmp_path / "normal.exr",
                                   camera={"eye": [0, 0, 1], "target": [0, 0, 0], "up": [0, 1, 0], "fov": 40})
    normal = wrinkle.evaluate(scene)["normal"]
    for axis in range(3):
        assert np.array_equal(written.plane(f"normal.{'xyz'[axis]}"), normal[..., axis])


def test_double_is_close_and_double(gbuffer, noise):
    normal, exact = (wrinkle.evaluate(noise, gbuffer, fp64=fp64)["normal"] for fp64 in (False, True))
    assert exact.dtype == np.float64 and 0 < np.abs(exact - normal).max() < 1e-5


def test_numbers_are_set_without_building_anew(gbuffer, noise):
    other = wrinkle.Scene(layers=[wrinkle.Noise(frequency=5, octaves=2, scale=0.01)], filter={"taps": 1})
    bumps = wrinkle.Pass(noise, gbuffer)
    bumps.set(other)
    assert np.array_equal(bumps.run(gbuffer)["normal"], wrinkle.evaluate(other, gbuffer)["normal"])
    with pytest.raises(wrinkle.Error, match="octaves"):
        bumps.set(wrinkle.Scene(layers=[wrinkle.Noise(octaves=3)], filter={"taps": 1}))


def test_a_frame_of_another_size_is_refused(camera, gbuffer, noise):
    with pytest.raises(wrinkle.Error, match="64 x 48 pixels; the frame has 8 x 4"):
        wrinkle.Pass(noise, gbuffer).run(wrinkle.GBuffer(camera=camera, depth=np.ones((4, 8))))


def test_decals_and_screen_derivatives(gbuffer):
    decal = wrinkle.Decal(texture=DATA / "textures" / "cracks_height.png", center=[0, 0, 0], half_size=[1, 1, 0.5],
                          scale=0.1)
    gradient = wrinkle.accumulate_decals(wrinkle.Scene(layers=[decal]), gbuffer)
    assert gradient.shape == (*SHAPE, 3) and np.abs(gradient).max() > 0.01
    dp_dx, dp_dy = wrinkle.screen_derivatives(gbuffer)
    pixel = 2 * 2 * np.tan(0.5) / SHAPE[0]
    assert np.allclose(dp_dx, (pixel, 0, 0), atol=1e-6) and np.allclose(dp_dy, (0, -pixel, 0), atol=1e-6)


def test_decals_on_arrays_know_the_objects_that_a_scene_names(camera, planes):
    decal = wrinkle.Decal(texture=DATA / "textures" / "cracks_height.png", center=[0, 0, 0], half_size=[1, 1, 0.5],
                          scale=0.1, mask=wrinkle.Mask(cryptomatte="cube"))
    nobody = wrinkle.GBuffer(camera=camera, depth=planes["depth"], cryptomatte=np.zeros((*SHAPE, 2), np.float32))
    assert not wrinkle.accumulate_decals(wrinkle.Scene(layers=[decal]), nobody).any()


def test_the_extension_module_has_type_stubs():
    assert "def devices() -> list[DeviceInfo]" in (pathlib.Path(wrinkle.__file__).parent / "_wrinkle.pyi").read_text()


def test_threads_may_have_a_pass_each(gbuffer, noise):
    wanted = wrinkle.evaluate(noise, gbuffer)["normal"]
    same = []
    threads = [threading.Thread(target=lambda: same.extend(
        np.array_equal(wrinkle.evaluate(noise, gbuffer)["normal"], wanted) for _ in range(5))) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert same == [True] * 10


def test_other_threads_run_meanwhile(camera, noise):
    shape = (512, 512)
    gbuffer = wrinkle.GBuffer(camera=camera, depth=np.full(shape, 2.0),
                              normal=np.broadcast_to(np.float32([0, 0, 1]), (*shape, 3)))
    bumps, counted, over = wrinkle.Pass(noise, gbuffer), [0], threading.Event()

    def count():
        while not over.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    for _ in range(5):
        bumps.run(gbuffer)
    during = counted[0] - before
    over.set()
    thread.join()
    assert during > 100


def test_what_progress_raises_comes_out_and_so_does_ctrl_c(gbuffer, noise):
    shares = []
    wrinkle.evaluate(noise, gbuffer, progress=shares.append)
    assert shares[-1] == 1
    with pytest.raises(ZeroDivisionError):
        wrinkle.evaluate(noise, gbuffer, progress=lambda share: 1 / 0)
    # Python leaves SIGINT ignored where whoever started it ignores it, as shells do for what they run behind.
    as_started = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            wrinkle.evaluate(noise, gbuffer, progress=lambda share: signal.raise_signal(signal.SIGINT))
    finally:
        signal.signal(signal.SIGINT, as_started)
    assert np.isfinite(wrinkle.evaluate(noise, gbuffer)["normal"]).all()


def test_memory_does_not_grow(gbuffer, noise):
    bumps = wrinkle.Pass(noise, gbuffer)
    for _ in range(200):
        bumps.run(gbuffer)
    gc.collect()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in range(1000):
        bumps.run(gbuffer)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 4096  # KiB


def test_buffers_of_pyopencl(camera, planes, gbuffer, noise):
    cl = pytest.importorskip("pyopencl")
    context = cl.create_some_context(interactive=False)
    queue = cl.CommandQueue(context)
    device = wrinkle.Device.adopt(context.int_ptr, queue.int_ptr)
    bumps = wrinkle.Pass(noise, gbuffer, device=device)
    size = -(-SHAPE[0] * SHAPE[1] // 64) * 64 * 4
    flags = cl.mem_flags
    inputs = {name: cl.Buffer(context, flags.READ_ONLY, size) for name in bumps.inputs}
    outputs = {name: cl.Buffer(context, flags.WRITE_ONLY, size) for name in bumps.outputs}
    for name, buffer in inputs.items():
        cl.enqueue_copy(queue, buffer, gbuffer.plane(name))
    pointer = bumps.enqueue({n: b.int_ptr for n, b in inputs.items()}, {n: b.int_ptr for n, b in outputs.items()})
    cl.Event.from_int_ptr(pointer, retain=False).wait()
    got = np.empty(SHAPE, np.float32)
    cl.enqueue_copy(queue, got, outputs["normal.x"])
    assert np.array_equal(got, wrinkle.evaluate(noise, gbuffer)["normal"][..., 0])


def test_run_writes_what_the_command_does(tmp_path):
    shares = []
    report = wrinkle.run(wrinkle.Scene.load(DATA / "scenes" / "constant.toml"), tmp_path, progress=shares.append)
    assert report.frames == 1 and {f.name for f in report.files} == {f.name for f in tmp_path.iterdir()}
    assert shares and report.cameras
    with pytest.raises(RuntimeError, match="enough"):
        def stop(share):
            raise RuntimeError("enough")
        wrinkle.run(wrinkle.Scene.load(DATA / "scenes" / "constant.toml"), tmp_path / "no", progress=stop)
    assert not (tmp_path / "no").exists() or not any((tmp_path / "no").iterdir())
