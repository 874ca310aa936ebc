"""What the commands say of the surface that they press, and of loads that it cannot resolve."""

import json
import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact import loading
from roughcontact.theory.plastic_asperities import plasticity

FORCE = ("--force", "10mN")


@pytest.mark.parametrize("command", [("press", *FORCE), ("curve", "--forces", "10mN,20mN")])
def test_the_index_of_plasticity_is_that_of_the_library(invoke, rough, surface, command):
    name, *load = command
    words = (name, rough, *load, "--modulus", "110GPa", "--hardness", "50GPa")
    record = json.loads(invoke(*words, "--json").stdout)["plasticity_index"]
    flat = surface.levelled("plane")
    summits = rc.find_summits(flat)
    index = plasticity.summit_index(summits.height, summits.mean_curvature, 110e9, 50e9)
    assert record["value"] == pytest.approx(index.value, rel=1e-12)
    assert record["regime"] == index.regime
    assert record["hardness"] == 50e9
    assert f"{index.value:.3g}, {index.regime} (elastic below 0.6" in invoke(*words).stdout


def test_named_materials_bring_the_hardness_of_the_softer(invoke, rough):
    words = ("press", rough, *FORCE)
    named = invoke(*words, "--materials", "steel,aluminium")
    assert "hardness 1.049 GPa of aluminium" in named.stdout
    record = json.loads(invoke(*words, "--materials", "aluminium,rigid", "--json").stdout)
    assert record["plasticity_index"]["hardness"] == rc.handbook("aluminium").hardness
    assert record["max_pressure"] > rc.handbook("aluminium").hardness  # which the contact itself is not given


def test_without_a_hardness_there_is_none(invoke, rough):
    answer = invoke("press", rough, *FORCE, "--modulus", "110GPa", "--json")
    assert json.loads(answer.stdout)["plasticity_index"] is None


def test_a_body_without_summits_has_no_index_and_is_pressed(invoke, tmp_path):
    rc.write(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), 1e-3), tmp_path / "ball.npz")
    answer = invoke("press", tmp_path / "ball.npz", *FORCE, "--materials", "steel,rigid")
    assert answer.exit_code == 0
    assert "plasticity index" not in answer.stdout + answer.stderr


@pytest.mark.parametrize(
    ("make", "kind"),
    [
        (lambda grid: rc.self_affine(grid, 0.8, 1e-7, np.random.default_rng(0)), "nominally flat"),
        (lambda grid: rc.shapes.paraboloid(grid, 1e-3), "with form"),
        (
            lambda grid: rc.self_affine(
                rc.Grid(grid.shape, grid.spacing, True), 0.8, 1e-7, np.random.default_rng(0)
            ),
            "periodic",
        ),
    ],
)
def test_a_curve_says_what_the_map_is(invoke, tmp_path, make, kind):
    rc.write(make(rc.Grid((48, 48), 1e-6)), tmp_path / "map.npz")
    words = ("curve", tmp_path / "map.npz", "--forces", "10mN,20mN", "--modulus", "110GPa")
    assert any(
        line.split() == ["kind", "of", "surface", *kind.split()]
        for line in invoke(*words).stdout.splitlines()
    )
    assert json.loads(invoke(*words, "--json").stdout)["kind"] == kind


def test_forces_that_the_grid_does_not_resolve_are_told_before_the_work(invoke, rough, monkeypatch):
    words = ("curve", rough, "--modulus", "110GPa", "--forces")
    monkeypatch.setattr(loading, "solutions_along", lambda *_, **__: (_ for _ in ()).throw(KeyboardInterrupt))
    for forces, message in (
        ("1nN:1uN:4", "none of the 4 forces can be resolved by this grid (4 too small"),
        ("100N:1kN:4", "none of the 4 forces can be resolved by this grid (4 near full contact)"),
    ):
        answer = invoke(*words, forces)
        assert answer.exit_code == 130  # it ended where the work begins
        assert f"Note: {message}" in answer.stderr
        assert "leave out --forces, and forces that suit the map are found" in answer.stderr


def test_fewer_resolved_forces_than_a_power_law_takes_are_told(invoke, tmp_path, monkeypatch):
    surface = rc.self_affine(rc.Grid((128, 128), 1e-6), 0.8, 1e-7, np.random.default_rng(3))
    rc.write(surface, tmp_path / "map.npz")
    found = rc.load_range(surface, 110e9)
    small, between = 1e-3 * found.lowest, math.sqrt(found.lowest * found.highest)
    words = ("curve", tmp_path / "map.npz", "--modulus", "110GPa", "--level", "none", "--forces")
    monkeypatch.setattr(loading, "solutions_along", lambda *_, **__: (_ for _ in ()).throw(KeyboardInterrupt))
    for resolved, told in ((2, True), (3, False)):
        forces = (small, 2 * small, *(between * 1.1**k for k in range(resolved)))
        message = f"{resolved} of the {len(forces)} forces can be resolved by this grid (2 too small"
        assert (message in invoke(*words, ",".join(map(str, forces))).stderr) is told


def test_forces_that_are_resolved_are_not_talked_about(invoke, tmp_path):
    surface = rc.self_affine(rc.Grid((128, 128), 1e-6), 0.8, 1e-7, np.random.default_rng(3))
    rc.write(surface, tmp_path / "map.npz")
    found = rc.load_range(surface, 110e9)
    words = ("curve", tmp_path / "map.npz", "--modulus", "110GPa", "--level", "none", "--forces")
    between = math.sqrt(found.lowest * found.highest)
    answer = invoke(*words, f"{between},{1.1 * between}")
    assert answer.exit_code == 0
    assert "can be resolved" not in answer.stderr
