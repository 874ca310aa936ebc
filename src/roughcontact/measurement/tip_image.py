"""The waves that a tip of finite radius changes."""

from __future__ import annotations

from roughcontact.surface.surface import Surface

__all__ = ["tip_limit"]

_BLUNT = 0.5  # of the tip's curvature: sharper summits are its image (Sanner et al., doi 10.1016/j.apsadv.2021.100190)


def tip_limit(surface: Surface, radius: float | None) -> float:
    """Return twice the lag along x above which no second difference is as negative as that of the tip [m]."""
    if radius is None:
        return 0.0
    heights, step = surface.heights, surface.grid.spacing[-1]
    for lag in range(1, (heights.shape[-1] - 1) // 2 + 1):
        second = heights[..., 2 * lag :] - 2 * heights[..., lag:-lag] + heights[..., : -2 * lag]
        if second.min() > -_BLUNT * (lag * step) ** 2 / radius:
            return 2 * lag * step
    return surface.grid.lengths[-1]
