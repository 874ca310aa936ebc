import numpy as np
import pytest

from roughcontact.study.task import canonical, generator, key_of
from study.trial import CASE, NEWER, Trial


def test_equal_parameters_have_one_text_whatever_way_they_are_written():
    assert canonical(Trial(hurst=1, size="1 mm")) == canonical(Trial(size=0.001, hurst=1.0))
    assert canonical(Trial(hurst=0.1)) == (
        '{"end":"well","hurst":0.1,"label":null,"points":4,"seconds":0.0,"size":0.001}'
    )


def test_a_key_stays_the_same_for_ever():
    # The stores of users hold these: another way to make keys would have everything computed again.
    assert key_of(CASE, canonical(Trial(hurst=0.1)), seed=1, sample=7) == (
        "60b455ef5556ad390dd09b12ea6b5bbd7c9498d2cec1e678a37d0b8bff7b897a"
    )


def test_whatever_changes_the_answer_changes_the_key():
    text, other = canonical(Trial(hurst=0.1)), canonical(Trial(hurst=np.nextafter(0.1, 1)))
    keys = {
        key_of(CASE, text, seed=0, sample=0),
        key_of(CASE, other, seed=0, sample=0),
        key_of(NEWER, text, seed=0, sample=0),
        key_of(CASE, text, seed=1, sample=0),
        key_of(CASE, text, seed=0, sample=1),
    }
    assert len(keys) == 5


def test_numbers_that_are_none_have_no_key():
    with pytest.raises(ValueError, match="JSON"):
        canonical(Trial.model_construct(hurst=np.nan))


def test_a_sample_draws_the_same_numbers_wherever_and_whenever():
    # By the definition of NumPy's seed sequences: the generator that `spawn` makes for the eighth child.
    expected = np.random.default_rng(np.random.SeedSequence(5).spawn(8)[7]).normal(size=4)
    np.testing.assert_array_equal(generator(5, 7).normal(size=4), expected)
    assert (generator(5, 8).normal(size=4) != expected).all()
