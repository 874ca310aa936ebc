"""The case of surfaces that stick."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.study.cases import find_case
from roughcontact.study.cases.adhesion_case import CASE, AdhesionParameters
from study.cases.pure import pure_record

GIVEN = {
    "points": 16,
    "size": "16 um",
    "hurst": 0.8,
    "rms": "0.1 um",
    "modulus": "10 MPa",
    "work": "10 mJ/m^2",
    "range": "0.1 um",
    "turn": 0.5,
    "loads": 6,
}


def run(seed=0, **given):
    return CASE.run(AdhesionParameters(**(GIVEN | given)), np.random.default_rng(seed))


def test_it_comes_with_the_package():
    assert find_case("adhesion") is CASE


@pytest.mark.parametrize("law", ["exponential", "dugdale"])
def test_it_is_the_loop_of_the_library(law):
    record = run(law=law)
    surface = rc.self_affine(rc.Grid((16, 16), 1e-6), 0.8, 1e-7, np.random.default_rng(0))
    adhesion = rc.Adhesion(10e-3, 1e-7, law)
    loop = rc.adhesive_loop(surface, 1e7, adhesion, depth=0.5e-7, points=6)
    np.testing.assert_allclose(record["depth"], loop.depth[:7], rtol=1e-12)
    # The sizes of the two grids differ by rounding.
    largest = np.abs(loop.force).max()
    np.testing.assert_allclose(record["force"], loop.force[:7], rtol=0, atol=1e-9 * largest)
    np.testing.assert_allclose(record["retreat_force"], loop.force[12:5:-1], rtol=0, atol=1e-9 * largest)
    assert record["retreat_force"][-1] == record["force"][-1]
    assert float(record["pull_off_force"]) == pytest.approx(loop.pull_off_force, rel=1e-9)
    assert int(record["jumps"]) == len(loop.jumps)
    assert float(record["residual"]) < 1e-8
    assert str(record["status"].item()) in ("converged", "no contact")


def test_the_pull_off_is_the_same_whatever_the_loads():
    few, many = (float(run(loads=loads)["pull_off_force"]) for loads in (2, 20))
    assert few == pytest.approx(many, rel=2e-6)  # each is found to 1e-6


def test_it_is_pure_and_survives_as_text():
    pure_record(run)


def test_what_the_grid_does_not_resolve_is_refused_unless_it_is_allowed():
    with pytest.raises(ValueError, match="would trap every state"):
        run(range="20 nm")
    few = {"points": 4, "size": "4 um", "loads": 2}
    assert bool(run(range="20 nm", allow_unresolved=True, **few)["unresolved"])


def test_a_study_of_it_goes_on(tmp_path):
    table = {"work": [5e-3, 10e-3]}
    given = {name: value for name, value in GIVEN.items() if name != "work"} | {"points": 8, "loads": 3}
    study = rc.study.Study(name="sticks", case="adhesion", seed=1, samples=1, parameters=given, table=table)
    rc.study.run(study, tmp_path / "sticks")
    more = study.model_copy(update={"samples": 2})
    rc.study.run(more, tmp_path / "sticks")
    with rc.study.Store.open(tmp_path / "sticks") as store:
        dataset = rc.study.export(store)
    assert dataset["pull_off_force"].sizes == {"work": 2, "sample": 2}
    assert (dataset["pull_off_force"].sel(work=10e-3) > dataset["pull_off_force"].sel(work=5e-3)).all()
    assert dataset["retreat_force"].sizes["load"] == 4
