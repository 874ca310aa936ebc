"""A pressure on trial: with the displacement that it causes, and the separation of the bodies."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from roughcontact.kernels import loader

__all__ = ["Trial"]

Array = npt.NDArray[np.float64]


class Trial(NamedTuple):
    """A pressure, nowhere negative, and what it amounts to.

    Attributes
    ----------
    pressure : array
        [Pa].
    displacement : array
        What it causes [m].
    separation : array
        Where nothing presses [m]; infinite where a cell never touches.
    """

    pressure: Array
    displacement: Array
    separation: Array

    def fits_machine_code(self, hardness: float) -> bool:
        """Whether machine code takes the fields as they lie in memory: it looks at nothing twice, knows no hardness."""
        shape = self.pressure.shape
        return hardness == math.inf and all(
            loader.takes(f) and f.dtype == np.float64 and f.flags.c_contiguous and f.shape == shape
            for f in self
        )
