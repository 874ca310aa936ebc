"""Answers stay what they were, to 1e-10, whatever the method: see `references.py`."""

import numpy as np
import pytest

import references


@pytest.fixture(scope="module")
def stored():
    with np.load(references.STORE) as fields:
        return dict(fields)


@pytest.mark.parametrize("number", range(references.COUNT))
def test_answers_are_what_they_were(number, stored):
    found, contact = references.answer(number)
    expected = stored[f"numbers{number}"]
    np.testing.assert_allclose(found, expected, rtol=1e-10)
    np.testing.assert_array_equal(contact, stored[f"contact{number}"])
