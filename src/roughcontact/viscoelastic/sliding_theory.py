"""Persson's theory beside hysteretic friction against speed."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from roughcontact.labels.labelled import variable
from roughcontact.labels.sliding_columns import BY_PERSSON
from roughcontact.theory.persson_theory import persson_friction
from roughcontact.theory.random_surfaces.waves import Waves

if TYPE_CHECKING:
    import xarray

    from roughcontact.surface.surface import Surface
    from roughcontact.viscoelastic.prony_series import Viscoelastic

__all__ = ["DOMAIN", "with_persson"]

DOMAIN = (
    "Persson's theory assumes isotropic random waves over some decades, far from full contact. gamma 1 is the theory "
    "of 2001, 1/2 the usual later value; the friction of a map with few waves differs from both."
)


def with_persson(dataset: xarray.Dataset, surface: Surface, material: Viscoelastic) -> xarray.Dataset:
    """Return the dataset of a `FrictionCurve` with friction and contact by Persson's theory, from the surface's waves.

    Raises
    ------
    InputError
        If the surface has no waves.
    """
    dy, dx = surface.grid.spacing
    waves, whole = Waves.of_heights(surface.heights, (dy, dx)), replace(material, band=None)
    pressure, speeds = float(dataset["nominal_pressure"]), dataset["sliding_speed"].to_numpy().tolist()
    values = [
        *(
            [persson_friction.friction_coefficient(pressure, whole, waves, v, gamma=gamma) for v in speeds]
            for gamma in (1.0, 0.5)
        ),
        [persson_friction.contact_fraction(pressure, whole, waves, v) for v in speeds],
    ]
    return dataset.assign(
        {
            each.name: variable(each.name, ("sliding_speed",), column)
            for each, column in zip(BY_PERSSON, values, strict=True)
        }
    )
