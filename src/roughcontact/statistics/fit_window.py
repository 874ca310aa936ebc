"""The points of a loading curve that the grid resolves, and those to which a power law is fitted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.statistics.power_law import FORCE_LIMIT, ROUNDING
from roughcontact.validation import Array, Mask, numeric, scalar

if TYPE_CHECKING:
    import xarray

__all__ = [
    "CELLS",
    "DECADE",
    "FULL_CONTACT_SHARE",
    "Window",
    "fitted_loads",
    "force_window",
    "is_resolved",
    "resolved_window",
    "window_of",
]

CELLS = 20  # thesis, section 4.3: below twenty one-cell stiffnesses the numbers depend on the grid
# Of the full-contact stiffness; above it the numbers depend on the finite size (eq. 4.14).
FULL_CONTACT_SHARE = 0.9
DECADE = 10 * (1 - ROUNDING)  # range of forces that a power law must span


def is_resolved(size: npt.NDArray[np.float64], cell: float, whole: float) -> npt.NDArray[np.bool_]:
    """Return whether stiffnesses (of a line contact: widths) lie between a few cells and full contact."""
    return np.asarray((size >= CELLS * cell) & (size < FULL_CONTACT_SHARE * whole))


def fitted_loads(force: Array, resolved: Mask, limit: float, unit: str) -> tuple[Mask, str]:
    """Return the loads to which a power law is fitted by default, and the rule in words.

    Parameters
    ----------
    force : array, shape (n,)
        Forces in any unit.
    resolved : array of bool, shape (n,)
    limit : float
        Largest force of a power law; if the resolved loads up to it span less than a decade, all of them are fitted.
    unit : str
    """
    light, count = resolved & (force <= limit * (1 + ROUNDING)), int(resolved.sum())
    lower = int(light.sum())
    if 0 < lower < count and force[light].max() >= DECADE * force[light].min():
        where = f"where F/(E* L h) is {FORCE_LIMIT:g} and the power law ends"
        return light, f"{lower} of {count} resolved loads, those up to {limit:.3g} {unit}, {where}"
    return resolved, f"all {count} resolved loads"


@dataclass(frozen=True, slots=True, eq=False)
class Window:
    """The dimensionless forces and mean stiffnesses between which a power law is fitted.

    Parameters
    ----------
    force : tuple of float
        Lowest and highest F/(E* h L); both belong to the window.
    stiffness : tuple of float or DataArray
        Limits of the mean k/(E* L), not included; arrays have dimensions of the ensembles.
    rule : str
        The window in words.

    Raises
    ------
    ValueError
        If the forces do not go from one to a larger one.
    """

    force: tuple[float, float]
    stiffness: tuple[Any, Any]
    rule: str

    def __post_init__(self) -> None:
        if not 0 <= self.force[0] < self.force[1]:
            raise InputError(
                f"a window goes from a dimensionless force to a larger one, not {self.force}", place="force"
            )


@numeric
def force_window(lowest: float, highest: float) -> Window:
    """Return the window between two dimensionless forces, whatever the stiffness.

    Parameters
    ----------
    lowest, highest : float
        Dimensionless forces F/(E* h L).

    Returns
    -------
    Window
        Both forces belong to it.

    Raises
    ------
    ValueError
        If the forces do not go from one to a larger one.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.statistics.force_window(1e-4, 0.07).rule
    'force from 0.0001 to 0.07'
    """
    return Window((lowest, highest), (0.0, np.inf), f"force from {lowest:g} to {highest:g}")


@numeric
def resolved_window(
    cell: float | xarray.DataArray,
    full_contact_stiffness: float | xarray.DataArray,
    highest: float = FORCE_LIMIT,
) -> Window:
    """Return the window of the thesis: stiffness above 20 cells (section 4.3), force up to 0.07 (section 4.5).

    Parameters
    ----------
    cell, full_contact_stiffness : float or DataArray
        k/(E* L) of a single cell and with all cells in contact, below 90 % of which the window ends; for N springs 1/N
        and 1.
    highest : float
        Dimensionless force.

    Returns
    -------
    Window
        Stiffness and force without dimension.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.statistics.resolved_window(1 / 512, 1.0).stiffness  # of 512 springs
    (0.0390625, 0.9)
    """
    for name, value in {"cell": cell, "full_contact_stiffness": full_contact_stiffness}.items():
        if not hasattr(value, "dims"):  # arrays lie along the ensembles of a dataset
            scalar(value, name)
    rule = (
        f"mean stiffness above {CELLS} cells and below {FULL_CONTACT_SHARE:g} of the full-contact stiffness, "
        f"force up to {highest:g}"
    )
    return Window((0.0, highest), (CELLS * cell, FULL_CONTACT_SHARE * full_contact_stiffness), rule)


def window_of(dataset: xarray.Dataset, samples: Sequence[str], points: str) -> Window:
    """Return the window of the thesis for loading curves that hold the stiffness of a cell.

    Parameters
    ----------
    dataset : Dataset
        With ``stiffness``, ``dimensionless_stiffness``, ``cell_stiffness`` and ``full_contact_stiffness``.
    samples : sequence of str
        Dimensions of the samples.
    points : str
        Dimension of the forces.

    Raises
    ------
    ValueError
        If a variable is missing, or the curves are those of line contacts, which have no such window.
    """
    wanted = ("stiffness", "dimensionless_stiffness", "cell_stiffness", "full_contact_stiffness")
    if missing := [name for name in wanted if name not in dataset]:
        raise InputError(
            f"the resolved loads are unknown without {', '.join(missing)}",
            "give a window, resolved_window(cell, full_contact_stiffness) or force_window(lowest, highest)",
        )
    if dataset.attrs.get("geometry") == Geometry.LINE.value:
        raise InputError(
            "for a line contact the stiffness does not show which loads are resolved",
            "give a window, force_window(...)",
        )
    # E* L, whatever the body is; it has no meaning where both are zero or infinite.
    stiffness = dataset["stiffness"]
    scale = stiffness.where((stiffness > 0) & np.isfinite(stiffness)) / dataset["dimensionless_stiffness"]
    cell, full_contact_stiffness = (
        _mean(dataset[name] / _mean(scale, points), *samples) for name in wanted[2:]
    )
    return resolved_window(cell, full_contact_stiffness)


def _mean(values: xarray.DataArray, *dims: str) -> xarray.DataArray:
    return values.mean([d for d in dims if d in values.dims])
