"""Quantities that are products of powers of a few base quantities: any independent set determines the others."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughcontact.errors import InputError
from roughcontact.validation import Array, fitting, positive

__all__ = ["Product", "checked", "solve"]

# Exponents are of order one: smaller ones are the rounding of zero.
ROUNDING = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class Product:
    """``factor * b0**e0 * b1**e1 * ...`` of the base quantities b.

    Parameters
    ----------
    exponents : tuple of float
        One for each base quantity.
    factor : float or array
        Pure number.
    unit : str
        Unit for messages.
    """

    exponents: tuple[float, ...]
    factor: float | Array = 1.0
    unit: str = ""


def checked(
    products: Mapping[str, Product], values: Sequence[ArrayLike | None], *, body: Collection[str] = ()
) -> dict[str, Array]:
    """Return those quantities that are given and not None, as numbers or arrays.

    Parameters
    ----------
    products : mapping of str to Product
        The quantities that may be given.
    values : sequence of (array_like or None)
        Their values, in the order of the products.
    body : collection of str
        Quantities that describe the unloaded body. If they are all given, the others may be 0.

    Raises
    ------
    ValueError
        If a value is not positive and finite.
    """
    given = dict(zip(products, values, strict=True))
    unloaded = bool(body) and all(given[name] is not None for name in body)
    return {
        name: positive(value, f"{name} [{products[name].unit}]", zero=unloaded and name not in body)
        for name, value in given.items()
        if value is not None
    }


def solve(products: Mapping[str, Product], known: Mapping[str, Array]) -> dict[str, Array]:
    """Return all quantities from n of them, with n the number of base quantities.

    Parameters
    ----------
    products : mapping of str to Product
        All quantities.
    known : mapping of str to array
        The given quantities; they are returned unchanged.

    Raises
    ------
    ValueError
        If too few or too many are known, those known depend on each other, or their shapes do not fit.
    """
    names = list(known)
    fitting({name: np.shape(value) for name, value in known.items()})
    exponents = np.array([products[name].exponents for name in names], dtype=np.float64)
    wanted = len(next(iter(products.values())).exponents)
    if len(names) != wanted:
        raise InputError(
            f"{wanted} of {', '.join(products)} determine the rest, not {len(names)}: {', '.join(names) or 'none'}"
        )
    if np.linalg.matrix_rank(exponents) < wanted:
        raise InputError(
            f"{', '.join(names)} depend on each other and do not determine the rest",
            f"replace one of them by another of {', '.join(products)}",
        )
    inverse = np.asarray(np.linalg.inv(exponents), dtype=np.float64)
    ratios = [known[name] / products[name].factor for name in names]
    return {name: known.get(name, _product(product, inverse, ratios)) for name, product in products.items()}


def _product(product: Product, inverse: Array, ratios: list[Array]) -> Array:
    powers = np.asarray(product.exponents) @ inverse
    # An exponent that is only rounding must be dropped: 0**1e-17 is 0, not 1.
    powers[np.abs(powers) < ROUNDING] = 0.0
    value: Array = product.factor * np.prod(np.broadcast_arrays(*map(np.power, ratios, powers)), axis=0)
    return value
