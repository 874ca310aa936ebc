"""From a figure of an ensemble to its averages, in stores that go on where they were stopped."""

from types import SimpleNamespace

import numpy as np
import pytest

from roughcontact.progress import listening
from roughcontact.study.executors.serial import Serial
from roughcontact.study.study import Study
from roughcontact_thesis import fig37_stiffness_of_sphere as fig37
from roughcontact_thesis.figures import FIGURES, figure, is_ensemble, module, verdicts
from roughcontact_thesis.reproduce import averages_of, planned, run_study


def study(samples=2):
    parameters = {"points": 9, "size": 1.0, "modulus": 1.0, "rms": 0.01, "loads": 3, "hurst": 1.0}
    return Study(name="few", case="curve", samples=samples, parameters=parameters)


@pytest.fixture
def found():
    return SimpleNamespace(
        studies=lambda scale: (study({"small": 2, "thesis": 4}[scale]),),
        averages=lambda data: data[["stiffness"]].mean("sample"),
    )


def test_studies_run_once_and_go_on(found, tmp_path):
    [small], [large] = planned(found), planned(found, "thesis")
    assert run_study(small, tmp_path, Serial()).done == 2
    told = []
    with listening(told.append):
        assert run_study(large, tmp_path, Serial()).done == 4
    assert [event.done for event in told if event.unit == "cases"] == [2, 3, 4, 4]
    assert [each.name for each in (tmp_path / "studies").iterdir()] == ["few"]
    four = averages_of(found, planned(found, "thesis"), tmp_path)
    assert np.isfinite(four["stiffness"]).all()


def test_another_seed_is_another_store(found, tmp_path):
    one, other = planned(found), planned(found, seed=7)
    assert (one[0].seed, other[0].seed) == (0, 7)
    assert other[0].name == "few-seed-7"
    assert other[0].parameters == one[0].parameters
    for each in one + other:
        run_study(each, tmp_path, Serial())
    first, second = (averages_of(found, each, tmp_path)["stiffness"] for each in (one, other))
    assert (first != second).any()


def test_what_was_not_run_is_told(found, tmp_path):
    with pytest.raises(ValueError, match=r"'few' was not run in .*: run it first"):
        averages_of(found, planned(found), tmp_path)


def test_figures_are_found_by_their_files_in_their_order():
    names = list(FIGURES)
    figures = [name for name in names if name.startswith("fig")]
    assert {"fig4", "fig18", "fig21", "fig26", "fig27", "fig28", "fig37"} <= set(figures)
    assert figures == sorted(figures, key=lambda name: int(name[3:]))
    outlook = names[len(figures) :]
    assert outlook == sorted(
        f"outlook-{word}" for word in ("cutoff", "energy", "flat", "hardness", "scale", "tangential")
    )


@pytest.mark.parametrize("name", FIGURES)
def test_every_figure_holds_what_its_kind_needs(name):
    found = module(name)
    assert len(found.SIZE) == 2
    if not is_ensemble(found):
        assert found.SEED >= 0
        assert callable(found.case)
        return
    for scale in ("small", "thesis"):
        studies = found.studies(scale)
        assert studies
        assert len({each.name for each in studies}) == len(studies)
        assert all(each.combinations() for each in studies)
    with pytest.raises(ValueError, match="stands on an ensemble"):
        figure(name)


def test_a_figure_without_verdicts_has_none():
    assert verdicts(SimpleNamespace(), None) == ()
    assert is_ensemble(fig37)
