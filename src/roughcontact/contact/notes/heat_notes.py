"""Notes on the thermal conductance of a joint by its parts, from the columns of a curve."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from roughcontact.labels.note import Note, Rank
from roughcontact.validation import Array

__all__ = ["ADDITIVE", "heat_notes"]

ADDITIVE = 0.2  # h l/k_s of gas and radiation, up to which they add to the spots; tests/fluid/test_joint_conductance.py
_MET = 1e-7  # of the drop; `TOLERANCE` of fluid.joint_conductance


def heat_notes(columns: Mapping[str, Array]) -> Iterator[Note]:
    """Yield the notes on the columns of `roughcontact.ConductanceParts`; none for other columns."""
    if "conductance_interaction" not in columns:
        return
    interaction, residual = (columns[f"conductance_{name}"] for name in ("interaction", "residual"))
    if count := int(np.sum(interaction > ADDITIVE)):
        yield Note(
            Rank.USUAL,
            f"At {count} of {len(interaction)} loads the parts do not add up (h l/k_s up to "
            f"{interaction.max():.2g}): the conductance of the joint is solved as a whole there.",
        )
    if not (residual <= _MET).all():
        yield Note(Rank.WRONG, f"The drop across the joint is met to {residual.max():.0e}, not {_MET:.0e}.")
    if (columns["radiation_conductance_per_area"] > 0.01 * columns["joint_conductance_per_area"]).any():
        yield Note(
            Rank.LIMITED,
            "Radiation counts here. Gaps below about 2 mm K over the temperature exchange more than computed.",
        )
