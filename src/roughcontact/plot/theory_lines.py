"""Theories beside computed curves, drawn on axes that the caller owns."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import cycle
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.plot.engineering_units import Scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from roughcontact.contact.compare import Law

__all__ = ["draw_laws"]

# Colours that every eye tells from the points and from each other, and dashes for eyes that see no colours. Five
# colours and four dashes have no common period: of twenty laws no two look the same.
_COLOURS = ("#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c564b")
_DASHES = ("-", (0, (5, 1.5)), (0, (3, 1.5, 1, 1.5)), (0, (1, 1)))
_POINTS = 200


def draw_laws(
    axes: Axes, laws: Sequence[Law], quantity: str, forces: tuple[float, float], scales: tuple[Scale, Scale]
) -> None:
    """Draw what each of the theories says about a quantity between two `forces` [N].

    A theory keeps its style from one picture to the next, whether or not it speaks of every quantity. The
    axes keep the limits that the computed points gave them.
    """
    x, y = scales
    force = np.geomspace(*forces, _POINTS)
    limits = axes.get_ylim()
    for law, colour, dashes in zip(laws, cycle(_COLOURS), cycle(_DASHES), strict=False):
        if quantity not in law.quantities:
            continue
        values = law.predict(quantity, force)
        shown = np.isfinite(values) & (values > 0)
        axes.plot(
            force[shown] * x.factor,
            values[shown] * y.factor,
            color=colour,
            linestyle=dashes,
            linewidth=1.4,
            zorder=2.5,
            label=law.name,
        )
    axes.set_ylim(limits)
