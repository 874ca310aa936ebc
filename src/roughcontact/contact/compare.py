"""A theory beside a computed curve: the same loads, the same quantities, and how far apart they are."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
import numpy.typing as npt

from roughcontact.contact.curve import Curve
from roughcontact.errors import InputError
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.labelled import plain_values
from roughcontact.statistics.local_exponent import LocalExponent, exponent_within, local_exponents
from roughcontact.statistics.power_law import ROUNDING
from roughcontact.validation import Array, shown

if TYPE_CHECKING:
    import xarray

    from roughcontact.theory.law import Scope

__all__ = ["Comparison", "Law", "compare", "with_theories"]


class Law(Protocol):
    """A theory of contact: quantities of a loading curve as functions of the normal force.

    `roughcontact.theory.law.LoadingLaw` is one; each theory has a function ``law`` that returns one.
    """

    @property
    def name(self) -> str:
        """Name of the theory."""
        ...

    @property
    def source(self) -> str:
        """The publication that it comes from."""
        ...

    @property
    def quantities(self) -> Mapping[str, Callable[[Array], Array]]:
        """The functions, by the names of a curve's quantities."""
        ...

    def predict(self, quantity: str, force: Array) -> Array:
        """Return a quantity at the forces [N]; NaN where the theory does not hold."""
        ...


@dataclass(frozen=True, eq=False, repr=False)
class Comparison:
    """Computed and predicted quantities at the forces of a curve.

    Attributes
    ----------
    name, source : str
        Of the theory.
    force : array, shape (n,)
        Loads [N].
    resolved : bool array, shape (n,)
        Loads at which the computed curve is reliable.
    computed, predicted : mapping of str to array, shape (n,)
        By quantity, in the units of the curve. Predictions are NaN where the theory does not hold.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((128, 128), 1e-6, periodic=True)
    >>> rng = np.random.default_rng(1)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=rng, rolloff=3.2e-5, short_cutoff=8e-6)
    >>> curve = rc.loading_curve(surface, 1e9, pressures=np.geomspace(1e6, 1e7, 9))
    >>> comparison = curve.compare(*rc.loading_laws(surface, 1e9, ["persson"]), ["contact_area", "stiffness"])
    >>> comparison.ratio("contact_area").round(2)
    array([0.8 , 0.77, 0.76, 0.76, 0.77, 0.77, 0.79, 0.81, 0.84])
    >>> f"off by {comparison.deviation('contact_area'):.0%} on {comparison.common('contact_area').sum()} loads"
    'off by 25% on 9 loads'
    >>> computed, predicted = comparison.local_exponents("contact_area")[0]
    >>> print(f"area ~ F^{computed.exponent:.2f}, by Persson F^{predicted.exponent:.2f}")
    area ~ F^1.03, by Persson F^0.99
    >>> comparison.words() in repr(comparison), comparison.to_record()["theory"]
    (True, 'Persson')
    """

    name: str
    source: str
    force: Array
    resolved: npt.NDArray[np.bool_]
    computed: Mapping[str, Array]
    predicted: Mapping[str, Array]

    def ratio(self, quantity: str) -> Array:
        """Return predicted over computed values.

        Parameters
        ----------
        quantity : str
            Name of a quantity that both have, such as ``"stiffness"``.

        Returns
        -------
        array, shape (n,)
            NaN where either is missing or the computed value is zero.
        """
        computed = self.computed[quantity]
        there = np.isfinite(computed) & (computed != 0)
        return np.asarray(
            np.divide(self.predicted[quantity], computed, out=np.full(computed.shape, np.nan), where=there)
        )

    def deviation(self, quantity: str) -> float:
        """Return the root mean square of ln(predicted/computed) over the `common` loads.

        Parameters
        ----------
        quantity : str
            Name of a quantity that both have, such as ``"stiffness"``.

        Returns
        -------
        float
            0.1 is about ten per cent; NaN without a common load.
        """
        ratio = self.ratio(quantity)[self.common(quantity)]
        return float(np.sqrt(np.mean(np.log(ratio) ** 2))) if ratio.size else float("nan")

    def common(self, quantity: str) -> npt.NDArray[np.bool_]:
        """Return the loads at which the two are compared.

        Parameters
        ----------
        quantity : str
            Name of a quantity that both have, such as ``"stiffness"``.

        Returns
        -------
        bool array, shape (n,)
            True where the load is resolved, the theory holds and both values are positive.
        """
        ratio = self.ratio(quantity)
        return np.asarray(self.resolved & np.isfinite(ratio) & (ratio > 0))

    def local_exponents(self, quantity: str) -> list[tuple[LocalExponent, LocalExponent | None]]:
        """Return the local exponents of the curve, and those of the theory in the same windows.

        Parameters
        ----------
        quantity : str
            Name of a quantity that both have, such as ``"stiffness"``.

        Returns
        -------
        list of tuple
            Computed and predicted exponents, window by window; None where the theory holds at fewer than four loads.
        """
        values = self.computed[quantity]
        shown = self.resolved & np.isfinite(values) & (values > 0)
        force, predicted = self.force[shown], self.predicted[quantity][shown]
        return [
            (each, exponent_within(force, predicted, each.window))
            for each in local_exponents(force, values[shown])
        ]

    def words(self) -> str:
        """Return the deviations as text.

        Returns
        -------
        str
            The deviation of every quantity, with the number of loads that were compared if not all resolved loads were.
        """
        resolved, parts = int(self.resolved.sum()), []
        for name in self.predicted:
            count = int(self.common(name).sum())
            on = "" if count == resolved else f" ({count} of {resolved} loads)"
            value = f" {self.deviation(name):.2f}{on}" if count else ": no load in common"
            parts.append(name.replace("_", " ") + value)
        return ", ".join(parts) or "nothing in common"

    def to_record(self) -> dict[str, Any]:
        """Return the comparison as plain values, for JSON; NaN becomes None.

        Returns
        -------
        dict
            Numbers, texts and lists of them, as JSON takes them.
        """
        return {
            "theory": self.name,
            "source": self.source,
            "predicted": {name: plain_values(values) for name, values in self.predicted.items()},
            "deviation": {name: plain_values(self.deviation(name)) for name in self.predicted},
            "loads_compared": {name: int(self.common(name).sum()) for name in self.predicted},
        }

    def __repr__(self) -> str:
        """Return the deviations, and the number of loads that were compared."""
        return f"Comparison({self.name}: rms ln ratio {self.words()})"


def compare(
    curve: Curve, theory: Law, quantities: Sequence[str] | None = None, *, other_surface: bool = False
) -> Comparison:
    """Return what a theory predicts at the loads of a curve, beside what was computed.

    Parameters
    ----------
    curve : Curve
    theory : Law
        For example ``rc.theory.persson.law(...)``, or one of `loading_laws`.
    quantities : sequence of str, optional
        Names of quantities of the curve; by default all that the theory predicts. For a theory of spots that flow, the
        stiffness is left out under a hardness, because the stiffness of the curve leaves out plastic cells.
    other_surface : bool
        Whether to accept a law that was made for another contact.

    Returns
    -------
    Comparison
        Computed and predicted values at every load, and their ratio.

    Raises
    ------
    ValueError
        If `theory` is not a theory or does not predict one of `quantities`, if the curve has no such quantity or is
        that of a line contact, or if the theory was made for another modulus, area or rms height.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> curve = rc.loading_curve(ball, 1e9, forces=[2e-4, 1e-3, 5e-3])
    >>> curve.compare(rc.theory.hertz.law(radius=1e-4, modulus=1e9)).ratio("depth").round(3)
    array([1.042, 1.015, 1.006])
    """
    if not hasattr(theory, "quantities"):
        name = theory if isinstance(theory, str) else "gw"
        raise InputError(
            f"compare takes a theory that was made for the surface, not {shown(theory)}",
            f"give rc.loading_laws(surface, modulus, {name!r})[0], or your own LoadingLaw",
            "theory",
        )
    if curve.geometry is Geometry.LINE:
        raise InputError("a line contact has forces per unit length, and the laws of theory have forces")
    scope = getattr(theory, "made_for", None)  # the user's laws need not have it
    if scope is not None and not other_surface:
        _require_alike(curve, theory.name, scope)
    names = list(theory.quantities if quantities is None else quantities)
    if quantities is None:
        hidden = curve.hardness < math.inf and getattr(theory, "plastic", False)
        names = [name for name in names if hasattr(curve, name) and not (hidden and "stiffness" in name)]
    if lacks := [name for name in names if not hasattr(curve, name)]:
        raise InputError(f"a curve has no {lacks[0]!r}; {theory.name} gives {sorted(theory.quantities)}")
    return Comparison(
        theory.name,
        theory.source,
        curve.force,
        curve.resolved,
        {name: np.asarray(getattr(curve, name), dtype=np.float64) for name in names},
        {name: theory.predict(name, curve.force) for name in names},
    )


def with_theories(dataset: xarray.Dataset, comparisons: Mapping[str, Comparison]) -> xarray.Dataset:
    """Return the dataset of a curve with the predictions of theories as further columns along ``load``.

    A column is named by the key of its comparison and the quantity: ``persson_contact_area``. It is NaN where the
    theory does not hold.
    """
    columns = {}
    for key, comparison in comparisons.items():
        for quantity, values in comparison.predicted.items():
            attributes = dict(dataset[quantity].attrs)
            attributes["long_name"] = f"{attributes['long_name']}, by {comparison.name}"
            attributes["references"] = comparison.source
            columns[f"{key.replace('-', '_')}_{quantity}"] = (("load",), values, attributes)
    return dataset.assign(columns)


def _require_alike(curve: Curve, name: str, scope: Scope) -> None:
    """Raise an error if a law was made for a contact other than that of the curve."""
    pairs = {
        "reduced modulus": (scope.modulus, curve.modulus, "Pa"),
        "nominal area": (scope.area, curve.nominal_area, "m^2"),
        "rms height": (scope.rms, curve.rms, "m"),
    }
    for what, (theirs, ours, unit) in pairs.items():
        if not math.isclose(theirs, ours, rel_tol=ROUNDING):
            differ = f"its {what} is {theirs:.6g} {unit}, that of the curve {ours:.6g} {unit}"
            remedy = "make it by loading_laws from the surface that was pressed, or compare with other_surface=True"
            raise InputError(f"the law of {name} was made for another contact: {differ}", remedy)
