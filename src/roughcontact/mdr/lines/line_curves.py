"""Loading curves of many rough lines, with means, scatter and power law."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError, about
from roughcontact.statistics.ensemble_fit import EnsembleFit, fit_ensemble
from roughcontact.statistics.fit_window import CELLS, FULL_CONTACT_SHARE
from roughcontact.statistics.power_law import FORCE_LIMIT, ROUNDING
from roughcontact.validation import Array, Mask, pair, require

__all__ = ["LineCurves", "Mean"]

Mean: TypeAlias = Literal["arithmetic", "geometric"]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class LineCurves:
    """Loading curves of rough lines on springs, at the same loads.

    Attributes
    ----------
    force : array, shape (loads,), of given depths (lines, loads)
        Normal force [N].
    depth : array, shape (lines, loads), if given (loads,)
        Approach since first touch [m].
    springs : int array, shape (lines, loads)
        Number of springs that carry load.
    elastic_energy : array, shape (lines, loads)
        Energy in the springs [J]; NaN if it was not requested.
    rms : array, shape (lines,)
        Root mean square height of each line [m].
    modulus : float
        Reduced modulus E* [Pa].
    spacing : float
        Width of a spring [m].
    points : int
        Springs in a line.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> from roughcontact.mdr import equivalent_line, line_curves, random_lines, rough_line
    >>> surface = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3).scaled(1e-6)
    >>> grid, line = rc.Grid(1024, 1e-3 / 1024, periodic=True), equivalent_line.line_spectrum(surface)
    >>> forces = np.geomspace(1e-3, 7.0, 12)  # up to 0.07 E* h L
    >>> parts = [
    ...     rough_line.loading_curves(heights, grid.spacing[0], 1e11, forces=forces)
    ...     for seed in (0, 1)
    ...     for heights in random_lines.rough_lines(grid, line, np.random.default_rng(seed), 20, rms=1e-6)
    ... ]
    >>> curves = line_curves.LineCurves.joined(parts)
    >>> f"{curves.resolved().sum()} of 12 loads resolved, k ~ F^{curves.fit().exponent:.2f} of {len(curves)} lines"
    '6 of 12 loads resolved, k ~ F^0.53 of 40 lines'
    >>> bool((curves.mean_stiffness() >= curves.mean_stiffness("geometric")).all())
    True
    """

    force: Array
    depth: Array
    springs: npt.NDArray[np.int32]
    elastic_energy: Array
    rms: Array
    modulus: float
    spacing: float
    points: int

    def __len__(self) -> int:
        """Return the number of lines."""
        return len(self.springs)

    @classmethod
    def joined(cls, parts: Iterable[LineCurves]) -> LineCurves:
        """Return the curves of all lines in `parts`, such as batches of an ensemble, as one.

        Parameters
        ----------
        parts : iterable of LineCurves
            Curves at the same loads.

        Returns
        -------
        LineCurves

        Raises
        ------
        ValueError
            If there is none, or the parts differ in loads, modulus or points.
        """
        batches = list(parts)
        require(len(batches) > 0, "there are no curves to join")
        first = batches[0]
        common = "force" if first.force.ndim == 1 else "depth"
        for other in batches[1:]:
            same = all(
                getattr(other, name) == getattr(first, name) for name in ("modulus", "spacing", "points")
            )
            if not (same and np.array_equal(getattr(other, common), getattr(first, common))):
                raise InputError("joined curves must have the same loads, modulus, spacing and points")
        found = "depth" if common == "force" else "force"
        names = (found, "springs", "elastic_energy", "rms")
        joined: dict[str, Any] = {name: np.concatenate([getattr(b, name) for b in batches]) for name in names}
        return replace(first, **joined)

    @property
    def contact_length(self) -> Array:
        """Length in contact [m], shape (lines, loads)."""
        return np.asarray(self.spacing * self.springs, dtype=np.float64)

    @property
    def stiffness(self) -> Array:
        """Contact stiffness dF/dd [N/m], E* times the length in contact, shape (lines, loads)."""
        return self.modulus * self.contact_length

    @property
    def length(self) -> float:
        """Length L of a line [m]."""
        return self.points * self.spacing

    @property
    def force_scale(self) -> float:
        """E* h L [N] (thesis, eq. 4.13); h is the rms height of all lines."""
        return self.stiffness_scale * float(np.sqrt(np.mean(self.rms**2)))

    @property
    def stiffness_scale(self) -> float:
        """E* L [N/m] (thesis, eq. 4.8), the stiffness of a line in full contact."""
        return self.modulus * self.length

    @property
    def dimensionless_force(self) -> Array:
        """Force over E* h L (thesis, eq. 4.13); NaN for flat lines."""
        scale = self.force_scale
        return self.force / scale if scale > 0 else np.full(self.force.shape, np.nan)

    @property
    def scatter(self) -> Array:
        """Standard deviation of the stiffness over its mean (thesis, fig. 18), shape (loads,); NaN for one line."""
        if len(self) < 2:
            return np.full(self.springs.shape[1], np.nan)
        mean = self.springs.mean(axis=0)
        # Without contact, at depth 0, all values are zero.
        return np.asarray(self.springs.std(axis=0, ddof=1) / np.where(mean > 0, mean, 1.0))

    def mean_stiffness(self, mean: Mean = "arithmetic") -> Array:
        """Return the mean over all lines of the stiffness at each load [N/m], shape (loads,).

        The geometric mean belongs to averages of ln k over ln F: it is lower by about half the variance of ln k, 4 %
        at a scatter of 30 %.

        Parameters
        ----------
        mean : {"arithmetic", "geometric"}
            Which mean over the lines.

        Returns
        -------
        array
            Mean stiffness [N/m], shape (loads,).
        """
        if mean not in ("arithmetic", "geometric"):
            raise about("mean", f"must be 'arithmetic' or 'geometric', not {mean!r}")
        if mean == "arithmetic":
            springs = self.springs.mean(axis=0)
        else:
            with np.errstate(divide="ignore"):  # no contact, at depth 0
                springs = np.exp(np.log(self.springs).mean(axis=0))
        return np.asarray(self.modulus * self.spacing * springs)

    def resolved(self, mean: Mean = "arithmetic") -> Mask:
        """Return the mask of loads whose mean stiffness is above 20 springs and below 90 % of all.

        Parameters
        ----------
        mean : {"arithmetic", "geometric"}
            Which mean over the lines.

        Returns
        -------
        bool array
            Shape (loads,).
        """
        springs = self.mean_stiffness(mean) / (self.modulus * self.spacing)
        return np.asarray((springs > CELLS) & (springs < FULL_CONTACT_SHARE * self.points))

    def fit(self, mean: Mean = "arithmetic", window: tuple[float, float] | None = None) -> EnsembleFit:
        """Return the power law k ~ F^alpha (thesis, eq. 4.53) of the mean stiffness, with standard errors.

        Parameters
        ----------
        mean : {"arithmetic", "geometric"}
            Which mean over the lines.
        window : tuple of float, optional
            Lowest and highest force [N]. By default the resolved points up to a dimensionless force of 0.07. A curve
            that is not exactly a power law has another exponent in another window.

        Returns
        -------
        EnsembleFit

        Raises
        ------
        ValueError
            If the depths were given and not the forces, or fewer than three forces lie in the window.
        """
        if self.force.ndim != 1:
            raise InputError(
                "lines can only be averaged at equal forces", "compute the curves with forces=, not depths="
            )
        if window is None:
            inside = self.resolved(mean) & (self.dimensionless_force <= FORCE_LIMIT * (1 + ROUNDING))
        else:
            low, high = pair(window, "window [N]")
            low, high = low * (1 - ROUNDING), high * (1 + ROUNDING)
            inside = (self.force >= low) & (self.force <= high)
        if inside.sum() < 3:
            raise InputError(
                f"a power law needs at least 3 forces in its window, not {int(inside.sum())}",
                f"give more forces, up to "
                f"{FORCE_LIMIT * self.force_scale:.3g} N, or lines of more than {self.points} points",
            )
        return fit_ensemble(
            self.force[inside],
            self.stiffness[:, inside],
            (self.force_scale, self.stiffness_scale),
            mean,
        )

    def __repr__(self) -> str:
        """Return the range of the curves, not their numbers."""
        force = f"force {self.force.min():.4g} to {self.force.max():.4g} N"
        return (
            f"LineCurves({len(self)} lines of {self.points} points, {self.springs.shape[1]} loads, {force})"
        )
