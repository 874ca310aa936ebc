"""Two loading curves of one contact, joined into one."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import numpy as np

from roughcontact.contact.curve import CURVE_POINTS, Curve
from roughcontact.errors import InputError
from roughcontact.labels.column import names_of
from roughcontact.labels.contact_columns import CERTIFICATES
from roughcontact.validation import Mask

__all__ = ["joined", "part_of"]

_COLUMNS = (*CURVE_POINTS, *names_of(CERTIFICATES), "spots")


def part_of(curve: Curve, chosen: Mask) -> Curve:
    """Return the loads of an elastic curve where `chosen`, shape (n,), is true."""
    status = tuple(each for each, kept in zip(curve.status, chosen, strict=True) if kept)
    columns: dict[str, Any] = {name: getattr(curve, name)[chosen] for name in _COLUMNS}
    kept = set(columns["force"].tolist())
    notes = tuple((force, note) for force, note in curve.state_notes if force in kept)
    measured = {name: values[chosen] for name, values in curve.measured.items()}
    return replace(curve, **columns, status=status, state_notes=notes, measured=measured)


def joined(first: Curve, second: Curve) -> Curve:
    """Return the loads of two elastic curves of one contact in the order of their depths.

    Elastic states do not depend on the loads before them, so a curve can be computed in parts.

    Parameters
    ----------
    first, second : Curve
        Curves of one surface and one modulus.

    Returns
    -------
    Curve
        The loads of both.

    Raises
    ------
    InputError
        If the curves differ in more than their loads, or something flows along them.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.contact.join_curves import joined
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> heavy, light = (rc.loading_curve(ball, 1e9, forces=forces) for forces in ([4e-2, 8e-2], [1e-2, 2e-2]))
    >>> joined(heavy, light)
    Curve(4 of 4 points resolved, force 0.01 to 0.08 N)
    """
    if first.flow is not None or second.flow is not None:
        raise InputError("what flows depends on the loads before", "compute all loads in one curve")
    for each in fields(Curve):
        ours, theirs = getattr(first, each.name), getattr(second, each.name)
        if each.name not in (*_COLUMNS, "status", "state_notes", "measured") and ours != theirs:
            raise InputError(
                f"the curves are of different contacts: {each.name} is {ours} and {theirs}",
                "join curves of one surface and one modulus",
                each.name,
            )
    if first.measured.keys() != second.measured.keys():
        raise InputError("the curves were measured in different ways", "give both the same measures")
    order = np.argsort(np.concatenate([first.depth, second.depth]), kind="stable")
    columns: dict[str, Any] = {
        name: np.concatenate([getattr(first, name), getattr(second, name)])[order] for name in _COLUMNS
    }
    measured = {
        name: np.concatenate([values, second.measured[name]])[order]
        for name, values in first.measured.items()
    }
    status = (*first.status, *second.status)
    light, heavy = sorted((first, second), key=lambda curve: curve.force.max(initial=0.0))
    lightest = [(force, note) for force, note in light.state_notes if force < light.force.max()]
    notes = (*heavy.state_notes, *lightest)
    return replace(
        first, **columns, status=tuple(status[k] for k in order), state_notes=notes, measured=measured
    )
