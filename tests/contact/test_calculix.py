"""The law of an interface in CalculiX: two blocks, pressed, sheared and heated through it, follow the table."""

import re
import subprocess
from contextlib import redirect_stdout
from dataclasses import replace
from io import StringIO
from pathlib import Path

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.evaluation.interface_calculix import calculix_text
from two_blocks import CONDUCTIVITY, HEIGHT, HOT, PROGRAM, Blocks, solve

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="CalculiX is not installed: there is no ccx in PATH")

STEEL = rc.Solid(210e9, 0.3)
FRICTION = 0.3
TABLE, EXPONENTIAL = ("ROUGH", "NODE TO SURFACE"), ("ROUGHEXP", "SURFACE TO SURFACE")
# The residual forces and flows are at most 1e-6 of their mean. A force changes the closing by p/K, which is at most a
# few times the closing from the begin of the table, so the closing is right to a few 1e-6 of itself.
RESIDUAL = 5e-6


PAGE = Path(__file__).parents[2] / "docs" / "coming-from" / "calculix.md"


@pytest.fixture(scope="module")
def table():
    """Return a table of more loads than CalculiX reads of a conductance."""
    grid = rc.Grid((64, 64), 1e-6, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, long_cutoff=3e-5, short_cutoff=6e-6)
    curve = rc.loading_curve(surface, STEEL, pressures=np.geomspace(1e8, 1e9, 24))
    found = rc.interface_table(curve, conductivities=(50.0, 50.0), bodies=STEEL, friction=FRICTION)
    assert len(found) == 24
    return found


@pytest.fixture(scope="module")
def slope(table):
    """Return the tangential stiffness per area at the geometric mean of the pressures."""
    logs = np.log(table.pressure), np.log(table.tangential["tangential_stiffness_per_area"])
    return np.exp(np.interp(np.log(table.pressure[[0, -1]]).mean(), *logs))


def closing_at(table, pressure):
    """Return the closing at a pressure [Pa] on straight lines between the loads."""
    return np.interp(pressure, np.append(0, table.pressure), np.append(0, table.overclosure))


def quiet(answer):
    """Return whether CalculiX finished, without a message about our lines.

    In a job with heat it counts each surface interaction as a material without a conductivity.
    """
    left = [line for line in answer.messages if "no conductivity" not in line]
    return answer.status == 0 and not left


@pytest.mark.parametrize("units", ["SI", "mm"])
def test_closing_and_slip_are_those_of_the_table(table, slope, tmp_path, units):
    text = calculix_text(table, units=units)
    between = np.sqrt(table.pressure[11] * table.pressure[12])
    below, last = 0.4 * table.pressure[0], table.pressure[-1]
    traction = 0.8 * FRICTION * table.pressure[3]  # below sliding
    steps = [(below, 0), (table.pressure[3], 0), (table.pressure[3], traction), (between, traction)]
    steps += [(between, -traction), (0.999 * last, 2 * traction)]
    answer = solve(Blocks(text, *TABLE, steps, units, poisson=0.3, sheared=True), tmp_path)
    assert quiet(answer), answer.messages
    for (pressure, tau), joint in zip(steps, answer.joints, strict=True):
        expected = closing_at(table, pressure)
        assert joint.closing == pytest.approx(expected, abs=joint.errors[0] + RESIDUAL * expected)
        assert joint.slip == pytest.approx(tau / slope, abs=joint.errors[1] + RESIDUAL * pressure / slope)


def test_more_traction_than_friction_holds_slides(table, tmp_path):
    """Nothing else holds the upper block: there is no equilibrium."""
    text, pressure = calculix_text(table), table.pressure[3]
    for share, slides in ((0.99, False), (1.01, True)):
        steps = [(pressure, 0), (pressure, share * FRICTION * pressure)]
        assert quiet(solve(Blocks(text, *TABLE, steps, sheared=True), tmp_path)) is not slides


@pytest.mark.parametrize(("units", "upper"), [("SI", (3, 3, 2)), ("mm", (4, 4, 2))])
def test_heat_and_closing_follow_conductance_and_exponential_law(table, tmp_path, units, upper):
    """Also where the nodes of the upper block do not meet those of the lower one."""
    text = calculix_text(table, units=units)
    # The 19 of 24 loads under *GAP CONDUCTANCE, which are evenly spread.
    few = np.linspace(0, 23, 19).round().astype(int)
    pressures = np.append(0, table.pressure[few])
    conductance = np.append(0, table.conductances["thermal_conductance_per_area"][few])
    between = np.sqrt(pressures[9] * pressures[10])
    steps = [(each, 0) for each in (0.8 * pressures[1], pressures[4], between, pressures[-1])]
    cells = ((3, 3, 2), upper)
    answer = solve(Blocks(text, *EXPONENTIAL, steps, units, cells, heated=True), tmp_path)
    assert quiet(answer), answer.messages
    rate, start = np.polyfit(np.log(table.pressure), table.overclosure, 1)
    for (pressure, _), joint in zip(steps, answer.joints, strict=True):
        expected = rate * np.log(pressure) + start
        assert joint.closing == pytest.approx(expected, abs=joint.errors[0] + RESIDUAL * rate)
        # In series: both blocks, and the interface.
        resistance = 1 / np.interp(pressure, pressures, conductance)
        drop = HOT * resistance / (2 * HEIGHT / CONDUCTIVITY + resistance)
        assert joint.drop == pytest.approx(drop, abs=joint.errors[2] + RESIDUAL * drop)


@pytest.mark.parametrize("units", ["SI", "mm"])
def test_loads_that_calculix_would_move_apart_are_left_out(table, tmp_path, units):
    """In metres CalculiX changes lines that are closer than 0.1 nm. Every fourth of these is written."""
    closing = 3e-11 * np.arange(1, 25)
    pressure = table.pressure * 1e-4
    smooth = replace(table, pressure=pressure, gap=1e-9 - closing, stiffness=pressure / closing)
    answer = solve(
        Blocks(calculix_text(smooth, units=units), *TABLE, [(smooth.pressure[19], 0)], units), tmp_path
    )
    assert quiet(answer), answer.messages
    joint, expected = answer.joints[0], smooth.overclosure[19]
    assert joint.closing == pytest.approx(expected, abs=joint.errors[0] + 2 * RESIDUAL * expected)


def test_heat_and_shear_go_together(table, slope, tmp_path):
    text, pressure = calculix_text(table), table.pressure[12]
    traction = 0.5 * FRICTION * pressure
    blocks = Blocks(text, *EXPONENTIAL, [(pressure, 0), (pressure, traction)], heated=True, sheared=True)
    answer = solve(blocks, tmp_path)
    assert quiet(answer), answer.messages
    slip = traction / slope
    # The upper face moves over the edge of the lower one, by a small part of its area, which carries nothing there.
    lost = 10 * slip / 1e-3
    assert answer.joints[1].slip == pytest.approx(
        slip, abs=answer.joints[1].errors[1] + (RESIDUAL + lost) * slip
    )
    assert lost < 1e-3


def test_the_model_of_the_page_gives_what_the_page_shows(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    page = PAGE.read_text(encoding="utf-8")
    (code,) = re.findall(r"^```python\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
    texts = re.findall(r"^```text\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
    (model,) = (text for text in texts if text.startswith("*NODE"))
    (shown,) = (text for text in texts if "displacements" in text)
    with redirect_stdout(StringIO()):
        exec(compile(code, str(PAGE), "exec"), {"__name__": "page"})  # which writes joint.inp
    Path("cubes.inp").write_text(model, encoding="utf-8")
    run = subprocess.run([PROGRAM, "-i", "cubes"], capture_output=True, encoding="utf-8", check=False)
    assert run.returncode == 0
    assert run.stdout.count("*WARNING") == run.stdout.count("no conductivity") == 2
    printed = Path("cubes.dat").read_text(encoding="utf-8")
    number = re.compile(r"-?\d\.\d+E[+-]\d+")
    assert number.sub("", printed).split() == number.sub("", shown).split()
    found, expected = (np.array(number.findall(text), float) for text in (printed, shown))
    # CalculiX ends where forces are right to 0.5 %, which changes the closing, a fifth of the displacement, less than
    # that. The loads of another processor differ by 1e-8.
    assert found == pytest.approx(expected, rel=1e-3, abs=1e-12)
