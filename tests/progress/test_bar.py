"""A bar of tqdm: what it shows, and what is said where there is none."""

import io
import sys

import pytest

import roughcontact as rc
from roughcontact.progress import bar, task, tracked

BALL = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)


def shown(work):
    pytest.importorskip("tqdm")
    screen = io.StringIO()
    with bar(file=screen, ascii=True):
        work()
    return screen.getvalue()


def test_a_curve_ends_with_its_loads():
    text = shown(lambda: rc.loading_curve(BALL, 1e9, forces=[1e-3, 2e-3, 4e-3]))
    assert "Pressing: 100%" in text
    assert "3 of 3 loads" in text
    assert "Solving" not in text.rsplit("3 of 3 loads", 1)[1]  # which is left on the screen


def test_what_counts_nothing_is_named_and_notes_follow():
    def work():
        with task("Reading part.x3p"):
            pass
        with task("tried", 2, "cases") as cases:
            cases.reached(2, "1 failed")

    text = shown(work)
    assert "Reading part.x3p" in text
    assert "2 of 2 cases" in text
    assert "1 failed" in text


def test_an_error_inside_closes_every_bar():
    def work():
        for _ in tracked(range(3), "Pressing", "loads"):
            raise ValueError("too much")

    tqdm = pytest.importorskip("tqdm").tqdm
    with pytest.raises(ValueError, match="too much"):
        shown(work)
    assert not getattr(tqdm, "_instances", ())


def test_a_path_that_is_left_open_is_closed_with_the_block():
    kept = []

    def work():
        kept.append(rc.loading_path(BALL, 1e9, forces=[1e-3, 2e-3]))
        next(kept[0])

    tqdm = pytest.importorskip("tqdm").tqdm
    assert "0 of 2 loads" in shown(work)
    assert not getattr(tqdm, "_instances", ())
    next(kept[0])  # nobody is told


def test_without_tqdm_the_remedy_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "tqdm", None)
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    with pytest.raises(ModuleNotFoundError, match=r"roughcontact\[notebook\]"), bar():
        pass
