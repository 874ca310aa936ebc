"""The ends of an axis or a colour scale without a few values far out, which would leave it mostly empty."""

from __future__ import annotations

import numpy as np

from roughcontact.surface.preparation.outliers import without_far
from roughcontact.validation import Array

__all__ = ["usual_range"]

_TAILS = (0.005, 0.995)  # quantiles of the remaining values
_ROOM = 0.05  # part of their range that is added at both ends


def usual_range(values: Array, share: float = 0.5, few: float = 0.02) -> tuple[float, float] | None:
    """Return the range of finite values without those far out; None if it is nearly the whole range.

    Nearly the whole means more than a `share` of it. If pits or peaks are more than a `few` of the values, they are not
    far out.
    """
    whole = float(values.min()), float(values.max())
    low, high = (float(end) for end in np.quantile(without_far(values, few), _TAILS))
    room = _ROOM * (high - low)
    low, high = max(low - room, whole[0]), min(high + room, whole[1])
    return (low, high) if 0 < high - low < share * (whole[1] - whole[0]) else None
