"""Array libraries other than NumPy, for tests that what goes in comes out.

`array_api_strict` knows nothing but the array API standard, and its second device refuses every way to NumPy. PyTorch's
tests run where it is installed; `make test` installs its CPU build where pip finds one. With
`ROUGHCONTACT_TEST_DEVICE=cuda` its arrays lie on a GPU, and CuPy's join them.
"""

import importlib.util
import os

import array_api_strict
import numpy as np
import pytest

DEVICE = array_api_strict.Device("device1")
UNDER_TEST = os.environ.get("ROUGHCONTACT_TEST_DEVICE", "cpu")


class Strict:
    """The standard and nothing else, on a device that is not the host."""

    @staticmethod
    def put(values, dtype="float64"):
        return array_api_strict.asarray(values, dtype=getattr(array_api_strict, dtype), device=DEVICE)

    @staticmethod
    def is_there(array):
        return isinstance(array, type(Strict.put(0.0))) and array.device == DEVICE

    @staticmethod
    def get(array):
        return np.asarray(array_api_strict.asarray(array, device=array_api_strict.Device("CPU_DEVICE")))


class Torch:
    """PyTorch on the host, or on the device under test."""

    @staticmethod
    def put(values, dtype="float64"):
        import torch

        return torch.asarray(values, dtype=getattr(torch, dtype), device=UNDER_TEST)

    @staticmethod
    def is_there(array):
        import torch

        return isinstance(array, torch.Tensor) and array.device.type == UNDER_TEST

    @staticmethod
    def get(array):
        return array.cpu().numpy()


class CuPy:
    """CuPy, which has no host."""

    @staticmethod
    def put(values, dtype="float64"):
        import cupy

        return cupy.asarray(values, dtype=dtype)

    @staticmethod
    def is_there(array):
        import cupy

        return isinstance(array, cupy.ndarray)

    @staticmethod
    def get(array):
        return array.get()


without_torch = pytest.mark.skipif(
    importlib.util.find_spec("torch") is None, reason="PyTorch is not installed"
)

LIBRARIES = [Strict, pytest.param(Torch, marks=without_torch), *([CuPy] if UNDER_TEST == "cuda" else [])]
