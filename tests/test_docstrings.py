"""Docstrings say what a caller needs, and their examples run."""

import doctest

import pytest

import roughcontact_thesis
from public_names import PublicName, public_names

NAMES = [*public_names(), *public_names(roughcontact_thesis)]
FLAGS = doctest.NORMALIZE_WHITESPACE | doctest.REPORT_NDIFF


def examples(name):
    """Return the example of a public name, with nothing imported but what it imports itself."""
    return doctest.DocTestFinder(recurse=False).find(name.value, name.path, globs={})


WITH_EXAMPLE = [test for name in NAMES for test in examples(name) if test.examples]


@pytest.mark.parametrize("room", sorted({name.room for name in NAMES}))
def test_public_docstrings_are_complete(room):
    assert {name.path: lacks for name in NAMES if name.room == room and (lacks := name.lacking())} == {}


@pytest.mark.parametrize("test", WITH_EXAMPLE, ids=lambda test: test.name)
def test_examples(test, tmp_path, monkeypatch):
    if test.name == "roughcontact.progress.bar":
        pytest.importorskip("tqdm")
    monkeypatch.chdir(tmp_path)  # what an example writes
    report = []
    doctest.DocTestRunner(optionflags=FLAGS).run(test, out=report.append)
    assert not report, "".join(report)


def test_names_reach_modules_classes_and_methods():
    paths = {name.path for name in NAMES}
    assert {
        "roughcontact.press",
        "roughcontact.foundation",  # the shortest of its paths
        "roughcontact.Surface.filtered",
        "roughcontact.Surface.rms",
        "roughcontact.theory.hertz.LineContact.pressure",
        "roughcontact.study.run",
        "roughcontact.shapes.sphere",
    } <= paths
    assert not any("._" in path for path in paths)


class Described:
    """A class whose users call it.

    Parameters
    ----------
    first : float
    other : float
    """

    def __init__(self, first, second):
        pass

    @property
    def bare(self):
        return 1


class Shown:
    """A class whose example calls one of its methods.

    Examples
    --------
    >>> from test_docstrings import Shown
    >>> Shown().called()
    1
    """

    def called(self):
        """Return one.

        Returns
        -------
        int
        """
        return 1

    def uncalled(self):
        """Return two.

        Returns
        -------
        int
        """
        return 2


def described(first, second):
    """Return one of two.

    Parameters
    ----------
    first
        No type.
    """
    return second


def undescribed():
    return 1


@pytest.mark.parametrize(
    ("value", "codes"),
    [
        (described, ["PR01", "PR04", "RT01", "EX01"]),
        (undescribed, ["GL08", "EX01"]),
        (Described, ["PR01", "PR02", "EX01"]),
        (Described.bare, ["GL08"]),
        (Shown, []),
        (Shown.called, []),
        (Shown.uncalled, ["EX01"]),
    ],
)
def test_what_is_lacking_is_seen(value, codes):
    name = PublicName("roughcontact.it", value)
    assert [lack[:4] for lack in name.lacking()] == codes
