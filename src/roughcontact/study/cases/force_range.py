"""Forces in equal ratios, without dimension: shared by several cases."""

from __future__ import annotations

from typing import Self

import numpy as np
import numpy.typing as npt
from pydantic import Field, model_validator

from roughcontact.study.case import Parameters

__all__ = ["ForceRange"]


class ForceRange(Parameters):
    """Parameters of a case that is pressed by forces ``F/(E* h L)``, h the rms height and L the side.

    Parameters
    ----------
    lowest_force, highest_force : float
        The first and the last.
    loads : int
        How many.
    """

    lowest_force: float = Field(gt=0)
    highest_force: float = Field(gt=0)
    loads: int = Field(ge=2)

    @model_validator(mode="after")
    def _rising(self) -> Self:
        if not self.lowest_force < self.highest_force:
            raise ValueError(
                f"lowest_force must be below highest_force, not {self.lowest_force:g} and {self.highest_force:g}"
            )
        return self

    @property
    def forces(self) -> npt.NDArray[np.float64]:
        """The forces, shape (loads,)."""
        return np.geomspace(self.lowest_force, self.highest_force, self.loads)
