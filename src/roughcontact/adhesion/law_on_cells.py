"""From what a user gives to a law on the cells of a computation."""

from __future__ import annotations

import numpy as np

from roughcontact.adhesion.attraction import LAWS, Adhesion, Attraction
from roughcontact.adhesion.elastic_form import ElasticForm
from roughcontact.validation import Array

__all__ = ["law_on"]


def law_on(adhesion: Adhesion, form: ElasticForm, separation: Array, modulus: float) -> Attraction:
    """Return the law on the cells of a computation.

    Parameters
    ----------
    adhesion : Adhesion
    form : ElasticForm
    separation : array, shape of the grid
        Undeformed gap [m]; infinite where nothing was measured, and nothing attracts.
    modulus : float
        Reduced modulus E* [Pa].
    """
    work = form.extended(np.where(np.isfinite(separation), adhesion.work, 0.0), 0.0)
    law = LAWS[adhesion.law]
    return law.on_cells(work, adhesion.range, adhesion.strength, form, separation, modulus)
