"""The command ``shear``: the table of the law, plastic flow, partial slip beside it, files, and Ctrl-C."""

import csv
import json
import re

import numpy as np
import pytest
import xarray

import roughcontact as rc

BODIES = ("--young", "10GPa", "--poisson", "0.3", "--young2", "10GPa", "--poisson2", "0.3")
SOLIDS = (rc.Solid(10e9, 0.3), rc.Solid(10e9, 0.3))
LAW = ("--friction", "0.2", "--amplitude", "0.5,0.8")


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    """A folder with a periodic map, the same heights as a free map, and a flat map."""
    here = tmp_path_factory.mktemp("shear")
    grid = rc.Grid((32, 40), (2e-6, 1e-6), periodic=True)
    tile = rc.self_affine(grid, hurst=0.8, rms=2e-7, rng=3, rolloff=2.4e-5, short_cutoff=8e-6)
    rc.write(tile, here / "tile.npz")
    rc.write(rc.Surface(tile.heights, rc.Grid((32, 40), (2e-6, 1e-6))), here / "free.npz")
    rc.write(rc.Surface(0 * tile.heights, grid), here / "flat.npz")
    return here


@pytest.fixture
def shear(invoke, home):
    def run(*words, pressures="5MPa,20MPa", bodies=BODIES, law=LAW, file="tile.npz"):
        return invoke("shear", home / file, *bodies, "--pressures", pressures, *law, *words)

    return run


@pytest.mark.usefixtures("drawn")
def test_the_table_is_the_law_of_the_normal_curve(shear, home, tmp_path):
    out = tmp_path / "out"
    answer = shear("--out", out)
    assert answer.exit_code == 0, answer.stderr
    surface = rc.read(home / "tile.npz").levelled("auto")
    with xarray.open_dataset(out / "shear.nc", engine="h5netcdf") as dataset:
        found = dataset.load()
    assert found["nominal_pressure"].values.tolist() == [5e6, 5e6, 2e7, 2e7]
    assert found["traction_share"].values.tolist() == [0.5, 0.8, 0.5, 0.8]
    # The displacement at every amplitude is the difference of two mean gaps, of pressures that are solved: to the
    # tolerance 1e-8 of both, relative to depths some times as large.
    for p, share, s in zip(
        *(found[name].values for name in ("nominal_pressure", "traction_share", "displacement_amplitude")),
        strict=True,
    ):
        gaps = [rc.press(surface, SOLIDS, pressure=each).mean_gap for each in (p * (1 - share), p)]
        assert s == pytest.approx(0.2 * 1.7 / 1.4 * (gaps[0] - gaps[1]), rel=1e-6)
    ratio = rc.theory.mindlin.pair_ratio(*SOLIDS)
    stiffness = found["interfacial_stiffness_per_area"] / found["tangential_stiffness_per_area"]
    np.testing.assert_allclose(stiffness, ratio, rtol=1e-12)
    header, first, *_ = answer.stdout.splitlines()[4:]
    assert re.split(r"  +", header.strip()) == [
        "nominal pressure [MPa]",
        "interfacial stiffness per area K/A0 [N/µm/mm²]",
        "tangential stiffness per area K_t/A0 [N/µm/mm²]",
        *(
            "gross slip [nm]",
            "tau/(mu p)",
            "displacement amplitude [nm]",
            "loss per cycle [mJ/m²]",
            "damping",
        ),
    ]
    shown = [float(cell) for cell in first.split()]
    factors = (1e-6, 1e-12, 1e-12, 1e9, 1, 1e9, 1e3, 1)
    columns = list(found.data_vars)[: len(factors)]
    values = [float(found[name][0]) * factor for name, factor in zip(columns, factors, strict=True)]
    assert shown == pytest.approx(values, rel=1e-3)  # four digits
    rows = list(csv.DictReader((out / "shear.csv").read_text().splitlines()))
    assert [float(row["cycle_loss [J m-2]"]) for row in rows] == found["cycle_loss"].values.tolist()
    record = json.loads((out / "shear.json").read_text())
    assert record["cycle_loss"] == found["cycle_loss"].values.tolist()
    assert record["units"]["tangential_stiffness_per_area"] == "Pa m-1"
    assert record["friction"] == 0.2
    assert record["converged"]
    assert record["whole"]
    assert (out / "shear.png").stat().st_size > 10_000
    assert "exact for Poisson's ratio 0" in answer.stderr
    assert "exact for Poisson's ratio 0" in " ".join(record["notes"])
    assert json.loads(shear("--json").stdout)["damping"] == record["damping"]
    assert not (out / "cycle.nc").exists()


def test_the_program_in_python_gives_the_same_numbers(shear, home):
    words = ("--after", "40MPa", "--hardness", "1GPa")
    program = shear(*words, "--print", "python").stdout
    known = {}
    exec(program, known)
    found = json.loads(shear(*words, "--json").stdout)
    assert found["cycle_loss"] == known["shear"]["cycle_loss"].values.tolist()
    assert found["gross_slip"] == known["shear"]["gross_slip"].values.tolist()


def test_after_flow_the_law_is_that_of_reloading(shear, home):
    surface = rc.read(home / "tile.npz").levelled("auto")
    hard = ("--hardness", "0.1GPa")
    answer = shear("--after", "40MPa", *hard, "--json")
    flowed, elastic = json.loads(answer.stdout), json.loads(shear("--json").stdout)
    assert "junction growth and the plastic flow under shear are neglected" in answer.stderr
    *_, solution = rc.loading_path(surface, SOLIDS, pressures=[40e6, 20e6], hardness=0.1e9)
    stiffness = solution.interfacial_stiffness / surface.grid.area
    # The slope of the law between loads is that of the contact to some per cent, where single cells come into contact.
    assert flowed["interfacial_stiffness_per_area"][-1] == pytest.approx(stiffness, rel=0.05)
    assert flowed["interfacial_stiffness_per_area"][-1] > 1.1 * elastic["interfacial_stiffness_per_area"][-1]
    # Without a larger load, the surface flows up to the largest pressure; a hardness that is not reached changes
    # nothing but the way: to the solvers' tolerance.
    to_the_largest = json.loads(shear(*hard, "--json").stdout)
    assert to_the_largest["gross_slip"][-1] > flowed["gross_slip"][-1]
    answer = shear("--hardness", "1TPa", "--json")
    never = json.loads(answer.stdout)
    assert "Nothing flowed: the contact is elastic." in answer.stderr
    assert never["displacement_amplitude"] == pytest.approx(elastic["displacement_amplitude"], rel=1e-6)


def test_a_free_map_has_a_law_up_to_its_lowest_load(shear):
    answer = shear("--json", file="free.npz")
    assert answer.exit_code == 0, answer.stderr
    record = json.loads(answer.stdout)
    assert record["gross_slip"] == [None] * 4
    assert None not in record["cycle_loss"]
    assert "first touch" in answer.stderr


def test_pressures_that_the_grid_does_not_resolve_and_amplitudes_of_single_cells_are_noted(shear):
    answer = shear(pressures="10kPa,20MPa", law=("--friction", "0.2", "--amplitude", "0.05,0.5"))
    assert "1 of 2 pressures, up to 10 kPa, are not resolved by the grid" in answer.stderr
    assert "have no loss: at their amplitudes, only single cells of the map slip." in answer.stderr
    assert "nan" in answer.stdout
    assert "not resolved by" not in shear(pressures="20MPa").stderr


def test_the_traction_that_spots_bear_is_noted_where_it_is_exceeded(shear):
    words = "exceeds the shear strength"
    assert words in shear("--shear-strength", "1MPa").stderr
    assert words not in shear("--shear-strength", "100GPa").stderr


def test_a_missed_tolerance_is_told_by_status_and_note(shear, monkeypatch):
    from roughcontact.contact import loading

    monkeypatch.setattr(loading, "solutions_along", _missed(loading.solutions_along))
    answer = shear("--json")
    assert answer.exit_code == 1, answer.stderr
    assert not json.loads(answer.stdout)["converged"]
    assert "1 of" in answer.stderr
    assert "missed the tolerance" in answer.stderr


def _missed(follow):
    """Return a function whose second state has missed its tolerance."""
    from dataclasses import replace

    from roughcontact.solver.control import Status

    def path(*given, **named):
        for k, solution in enumerate(follow(*given, **named)):
            yield replace(solution, status=Status.STAGNATED) if k == 1 else solution

    return path


@pytest.mark.usefixtures("drawn")
def test_partial_slip_stands_beside_the_law(shear, home, tmp_path):
    out = tmp_path / "out"
    answer = shear("--compute", "--out", out)
    assert answer.exit_code == 0, answer.stderr
    surface = rc.read(home / "tile.npz").levelled("auto")
    pressed = rc.press(surface, SOLIDS, pressure=20e6)
    cycles = [
        rc.shear_cycle(pressed, SOLIDS, friction=0.2, traction=share * 0.2 * 20e6) for share in (0.5, 0.8)
    ]
    record = json.loads((out / "shear.json").read_text())
    assert record["computed_loss"][:2] == [None, None]
    # The contact that is sheared is solved twice, to 1e-8.
    assert record["computed_loss"][2:] == pytest.approx([each.loop.loss for each in cycles], rel=1e-6)
    displacement = [float(each.loop.displacement[0]) for each in cycles]
    assert record["computed_displacement"][2:] == pytest.approx(displacement, rel=1e-6)
    for name, by_law in (("displacement", "displacement_amplitude"), ("loss", "cycle_loss")):
        pairs = zip(record[by_law][2:], record[f"computed_{name}"][2:], strict=True)
        expected = [law / computed - 1 for law, computed in pairs]
        assert record[f"{name}_difference"][2:] == pytest.approx(expected, rel=1e-9)
    assert "by partial slip at 20 MPa" in answer.stdout
    assert f"{record['loss_difference'][-1]:+.2%}" in answer.stdout
    with xarray.open_dataset(out / "cycle.nc", engine="h5netcdf") as dataset:
        np.testing.assert_allclose(
            dataset["heat"], cycles[-1].heat, rtol=1e-5, atol=1e-6 * cycles[-1].heat.max()
        )
    assert "cycle.nc, shear.csv, shear.json, shear.nc and shear.png are in" in answer.stderr


def test_without_poisson_s_ratio_partial_slip_is_the_law(shear):
    bodies = ("--young", "10GPa", "--poisson", "0", "--young2", "10GPa", "--poisson2", "0")
    for more in ((), ("--hardness", "1GPa")):
        answer = shear("--compute", "--json", *more, bodies=bodies, pressures="20MPa")
        assert answer.exit_code == 0, answer.stderr
        record = json.loads(answer.stdout)
        # Displacements follow from gaps of solved pressures: to the tolerance of 1e-8 of depths.
        assert record["displacement_difference"] == pytest.approx([0, 0], abs=1e-6)
        # Loss and stiffness follow from the curve between its loads.
        assert record["loss_difference"] == pytest.approx([0, 0], abs=0.02)
        assert record["stiffness_difference"] == pytest.approx([0, 0], abs=0.05)


def test_a_cycle_up_to_gross_slip(shear):
    answer = shear("--compute", "--json", pressures="20MPa", law=("--friction", "0.2", "--amplitude", "1"))
    assert answer.exit_code == 0, answer.stderr
    record = json.loads(answer.stdout)
    assert record["slip_fraction"] == [1.0]
    assert record["displacement_amplitude"] == pytest.approx(record["gross_slip"], rel=1e-9)


def test_ctrl_c_during_partial_slip_keeps_the_law(shear, monkeypatch, tmp_path):
    def stopped(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("roughcontact.joints.slip_cycle.slide_path", stopped)
    out = tmp_path / "out"
    answer = shear("--compute", "--out", out)
    assert answer.exit_code == 130
    assert "stopped: cycles by partial slip are left out" in answer.stderr
    record = json.loads((out / "shear.json").read_text())
    assert not record["whole"]
    assert len(record["cycle_loss"]) == 4
    assert "computed_loss" not in record


def test_ctrl_c_during_the_curve_leaves_nothing(shear, monkeypatch, tmp_path):
    def stopped(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(rc, "loading_curve", stopped)
    answer = shear("--out", tmp_path / "out")
    assert answer.exit_code == 130
    assert "Interrupted" in answer.stderr
    assert not (tmp_path / "out").exists()
