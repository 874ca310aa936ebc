"""Curves that were computed in parts are the curve that is computed in one."""

from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact.join_curves import joined

GRID = rc.Grid((32, 24), (1e-6, 2e-6))
ROUGH = rc.self_affine(GRID, 0.8, 1e-7, np.random.default_rng(1))
FORCES = np.geomspace(1e-5, 1e-3, 6)


def curve(forces, **named):
    return rc.loading_curve(ROUGH, 1e9, forces=forces, **named)


def test_parts_are_the_whole_whatever_their_order():
    whole, even, odd = curve(FORCES), curve(FORCES[::2]), curve(FORCES[1::2])
    for found in (joined(even, odd), joined(odd, even)):
        assert len(found) == 6
        assert found.status == whole.status
        assert (found.spots == whole.spots).all()
        # Each load meets the tolerance of 1e-8 from another start.
        np.testing.assert_allclose(found.force, whole.force, rtol=1e-9)
        np.testing.assert_allclose(found.depth, whole.depth, rtol=1e-7)
        np.testing.assert_allclose(found.stiffness, whole.stiffness, rtol=1e-6)


def test_curves_of_different_contacts_are_refused():
    first = curve(FORCES[:1])
    with pytest.raises(rc.InputError, match="different contacts: modulus is") as refused:
        joined(first, replace(first, modulus=2e9))
    assert refused.value.place == "modulus"
    with pytest.raises(rc.InputError, match="loads before: compute all loads in one curve"):
        joined(first, curve(FORCES[1:2], hardness=1e8))
