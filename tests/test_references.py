"""Answers stay what they were, whatever the method: see `references.py`."""

import numpy as np
import pytest

import references

# Ten times the tolerance of a state, which is relative to the largest traction.
OWN = 10 * 1e-8


@pytest.fixture(scope="module")
def stored():
    with np.load(references.STORE) as fields:
        return dict(fields)


@pytest.mark.parametrize("number", references.LOADS)
def test_answers_are_what_they_were(number, stored):
    found, contact = references.answer(number)
    expected = stored[f"numbers{number}"]
    np.testing.assert_allclose(found, expected, rtol=1e-10)
    np.testing.assert_array_equal(contact, stored[f"contact{number}"])


@pytest.mark.parametrize("number", references.LOOPS)
def test_loops_are_what_they_were(number, stored):
    found, spots = references.loop(number)
    np.testing.assert_allclose(found, stored[f"numbers{number}"], rtol=OWN)
    np.testing.assert_array_equal(spots, stored[f"contact{number}"])


@pytest.mark.slow
@pytest.mark.parametrize("number", references.PATHS)
def test_states_and_jumps_of_adhesive_contact_are_what_they_were(number, stored):
    found, jumps = references.path(number)
    for now, before in zip(found, stored[f"numbers{number}"], strict=True):
        scale = np.abs(before[np.isfinite(before)]).max()
        np.testing.assert_allclose(now, before, rtol=0, atol=OWN * scale)
    before = stored[f"contact{number}"]
    np.testing.assert_array_equal(jumps[:, 0], before[:, 0])  # in which direction
    assert (
        np.abs(jumps[:, 1] - before[:, 1]) <= jumps[:, 2] + before[:, 2]
    ).all()  # at which depth, to the brackets


def test_some_of_the_paths_jump(stored):
    """The test above checks no jump otherwise."""
    jumps = np.concatenate([stored[f"contact{number}"] for number in references.PATHS])
    assert (jumps[:, 0] == 1).sum() > 10
    assert (jumps[:, 0] == 0).sum() > 10
