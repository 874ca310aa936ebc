"""Array libraries other than NumPy, for tests that what goes in comes out.

`array_api_strict` knows nothing but the array API standard, and its second device refuses every way to NumPy. PyTorch's
tests run where it is installed; `make test` installs its CPU build where pip finds one.
"""

import importlib.util

import array_api_strict
import numpy as np
import pytest

DEVICE = array_api_strict.Device("device1")


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
    """PyTorch on the host."""

    @staticmethod
    def put(values, dtype="float64"):
        import torch

        return torch.asarray(values, dtype=getattr(torch, dtype))

    @staticmethod
    def is_there(array):
        import torch

        return isinstance(array, torch.Tensor)

    @staticmethod
    def get(array):
        return array.numpy()


without_torch = pytest.mark.skipif(
    importlib.util.find_spec("torch") is None, reason="PyTorch is not installed"
)

LIBRARIES = [Strict, pytest.param(Torch, marks=without_torch)]
