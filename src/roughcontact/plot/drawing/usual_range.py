"""Where an axis or a scale of colours ends that a few values far out would leave largely empty."""

from __future__ import annotations

import numpy as np

from roughcontact.surface.preparation.outliers import without_far
from roughcontact.validation import Array

__all__ = ["usual_range"]

_TAILS = (0.005, 0.995)  # quantiles of what is left
_ROOM = 0.05  # beyond these, of what they span


def usual_range(values: Array, share: float = 0.5, few: float = 0.02) -> tuple[float, float] | None:
    """Return the lowest and the highest of finite values without those far out; None where that is all or nearly so.

    Nearly so is more than a `share` of the range. More than a `few` of the values, pits or peaks, are not far out.
    """
    whole = float(values.min()), float(values.max())
    low, high = (float(end) for end in np.quantile(without_far(values, few), _TAILS))
    room = _ROOM * (high - low)
    low, high = max(low - room, whole[0]), min(high + room, whole[1])
    return (low, high) if 0 < high - low < share * (whole[1] - whole[0]) else None
