"""Kernel functions over arrays."""

import numpy as np
import pytest

import wrinkle


def test_resolve_is_the_normalised_difference():
    random = np.random.default_rng(1)
    n = random.normal(size=(1000, 3))
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    g = np.cross(n, random.normal(size=(1000, 3)))
    wanted = (n - g) / np.linalg.norm(n - g, axis=1, keepdims=True)
    assert np.abs(wrinkle.eval("resolve", n=n, g=g)["normal"] - wanted).max() < 1e-6
    exact = wrinkle.eval("resolve", n=n, g=g, fp64=True)["normal"]
    assert exact.dtype == np.float64 and np.abs(exact - wanted).max() < 1e-14


def test_every_function_is_named():
    assert "resolve" in wrinkle.functions() and len(wrinkle.functions()) > 20


@pytest.mark.parametrize("call, said", [
    (lambda: wrinkle.eval("resolv", n=[[0, 0, 1]]), 'did you mean "resolve"'),
    (lambda: wrinkle.eval("resolve", n=[[0, 0, 1]], q=3), 'no parameter or setting "q"'),
    (lambda: wrinkle.eval("resolve", n=[[0, 1]]), "(rows, 3); found (1, 2)"),
    (lambda: wrinkle.eval("displace", h=np.zeros((5, 3))), "(rows,); found (5, 3)"),
    (lambda: wrinkle.eval("resolve", n=[[0, 0, 1]]), '"g'),
    (lambda: wrinkle.eval("resolve", n=[[0, 0, 1]], g=[[0, 0, 1]] * 2), "rows"),
    (lambda: wrinkle.eval("resolve", n=[[0, 0, 1]], g=[[0, 0, 1]], precision="exakt"), '"exakt"'),
])
def test_mistakes_are_told_by_name(call, said):
    with pytest.raises(wrinkle.Error) as error:
        call()
    assert said in str(error.value)
