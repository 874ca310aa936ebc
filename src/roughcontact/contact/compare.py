"""A theory beside a computed curve: the same loads, the same quantities, and how far apart they are."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
import numpy.typing as npt

from roughcontact.labels.labelled import plain_values
from roughcontact.statistics.local_exponent import LocalExponent, exponent_within, local_exponents
from roughcontact.validation import Array

if TYPE_CHECKING:
    import xarray

__all__ = ["Comparison", "Law", "with_theories"]


class Law(Protocol):
    """What a theory offers: quantities of a loading curve as functions of the normal force.

    `roughcontact.theory.law.LoadingLaw` is one; the theories make theirs by a function ``law``.
    """

    @property
    def name(self) -> str:
        """Name of the theory."""
        ...

    @property
    def source(self) -> str:
        """Where it comes from."""
        ...

    @property
    def quantities(self) -> Mapping[str, Callable[[Array], Array]]:
        """By the names of a curve's quantities."""
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
        Where the computed curve is to be relied upon.
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
        """Return the deviations as a text.

        Returns
        -------
        str
            The deviation of every quantity, and on how many of the resolved loads it rests where not on all.
        """
        resolved, parts = int(self.resolved.sum()), []
        for name in self.predicted:
            count = int(self.common(name).sum())
            on = "" if count == resolved else f" ({count} of {resolved} loads)"
            value = f" {self.deviation(name):.2f}{on}" if count else ": no load in common"
            parts.append(name.replace("_", " ") + value)
        return ", ".join(parts) or "nothing in common"

    def to_record(self) -> dict[str, Any]:
        """Return the comparison as plain values, for JSON; None where there is no number.

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
        """Say how far apart the two are, and on how many loads that rests."""
        return f"Comparison({self.name}: rms ln ratio {self.words()})"


def with_theories(dataset: xarray.Dataset, comparisons: Mapping[str, Comparison]) -> xarray.Dataset:
    """Return the dataset of a curve with what theories say as further columns along ``load``.

    A column is named by the key of its comparison and the quantity: ``persson_contact_area``. Where a theory does not
    hold it is NaN.
    """
    columns = {}
    for key, comparison in comparisons.items():
        for quantity, values in comparison.predicted.items():
            attributes = dict(dataset[quantity].attrs)
            attributes["long_name"] = f"{attributes['long_name']}, by {comparison.name}"
            attributes["references"] = comparison.source
            columns[f"{key.replace('-', '_')}_{quantity}"] = (("load",), values, attributes)
    return dataset.assign(columns)
