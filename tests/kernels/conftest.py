"""A package of two small families of machine code, and an empty folder to keep it in."""

import importlib.util

import numpy as np
import platformdirs
import pytest

from roughcontact.kernels import disk, loader

TINY = '''
"""Adds a number to some."""

from roughcontact.kernels.code import Code
from roughcontact.kernels.signature import Scalar, Vector, kernel
from roughcontact.kernels.values import Index


@kernel
def add(code: Code, n: Index, x: Vector, by: Scalar) -> None:
    for i in code.range(0, n):
        x[i] = x[i] + by
'''


@pytest.fixture
def kept(monkeypatch, tmp_path):
    """Return the folder for caches, which is empty, of a package with two small families: one adds, one subtracts."""
    if disk.private(tmp_path) is None:
        pytest.skip("others can write to the folder of the tests")
    source, caches = tmp_path / "source", tmp_path / "caches"
    source.mkdir()
    for name in loader.COMMON:
        (source / f"{name}.py").write_bytes(loader._text(name))
    families = {"tiny": TINY, "other": TINY.replace("+ by", "- by")}
    for name, text in families.items():
        (source / f"{name}.py").write_text(text)
        spec = importlib.util.spec_from_file_location(name, source / f"{name}.py")
        families[name] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(families[name])
    monkeypatch.setattr(loader, "_families", lambda: families)
    monkeypatch.setattr(loader, "_text", lambda name: (source / f"{name}.py").read_bytes())
    monkeypatch.setattr(platformdirs, "user_cache_path", lambda name: caches / name)
    loader.functions.cache_clear()
    yield caches / "roughcontact"
    loader.functions.cache_clear()


@pytest.fixture
def translated(monkeypatch):
    """Return a list that grows with each translation."""
    done, translate = [], loader._translated

    def counted(kernels, precision):
        done.append((next(iter(kernels.values())).body.__module__, precision))
        return translate(kernels, precision)

    monkeypatch.setattr(loader, "_translated", counted)
    return done


@pytest.fixture
def works():
    """Return what says whether a new process would have the function: this one forgets it first."""

    def found(precision="float64"):
        loader.functions.cache_clear()
        numbers = np.arange(5, dtype=precision)
        loader.functions("tiny", precision)["add"](5, numbers, 0.5)
        return numbers.tolist() == [0.5, 1.5, 2.5, 3.5, 4.5]

    return found
