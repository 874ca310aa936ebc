"""Viscoelastic contact in time: limits, energies, certificates, what is counted, and bad input."""

import re

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.viscoelastic.relaxation_step import Transition

SOLID = rc.Viscoelastic(1.0, [2.0, 3.0], [0.5, 4.0])
CREEP = SOLID.creep()
PERIODIC = rc.self_affine(
    rc.Grid((32, 32), 1 / 32, periodic=True), hurst=0.8, rms=0.01, rng=3, rolloff=0.5, short_cutoff=0.25
)
FREE = rc.self_affine(rc.Grid((32, 32), 1 / 32), hurst=0.8, rms=0.01, rng=4, rolloff=0.5, short_cutoff=0.25)
HOLED = rc.Surface(np.where(np.arange(32) == 5, np.nan, FREE.heights), FREE.grid)
LINE_GRID = rc.Grid((64,), 1 / 64, periodic=True)
LINE = rc.Surface(0.01 * np.cos(2 * np.pi * LINE_GRID.coordinates[0]), LINE_GRID)
ON_A_LINE = {"operator": rc.line(LINE_GRID, SOLID.instantaneous)}
SOFT = {"time_tolerance": 1e-2}


def path(surface, material=SOLID, **history):
    return list(rc.viscoelastic_path(surface, material, **history))


def load_of(surface):
    """Return a force under which about a tenth of the cells touch at the relaxed modulus."""
    return 0.02 if surface.grid.ndim == 2 else 0.01


@pytest.mark.parametrize(
    ("surface", "more"),
    [(PERIODIC, {}), (FREE, {}), (HOLED, {}), (LINE, ON_A_LINE)],
    ids=["periodic", "free", "holed", "line"],
)
def test_a_jump_and_a_long_hold_are_elastic_contacts(surface, more):
    force, longest = load_of(surface), max(CREEP.times)
    states = path(
        surface, times=[0, 0, 40 * longest], forces=[0, force, force], steps=100, tolerance=1e-10, **more
    )
    assert [state.prescribed for state in states[:3]] == [True, True, False]
    for state, modulus in ((states[1], SOLID.instantaneous), (states[-1], SOLID.equilibrium)):
        body = {} if not more else {"operator": rc.line(LINE_GRID, modulus)}
        elastic = rc.press(surface, modulus, force=force, tolerance=1e-10, **body)
        assert state.depth == pytest.approx(elastic.depth, rel=1e-8)
        assert state.pressure == pytest.approx(elastic.pressure, abs=1e-8 * elastic.max_pressure)
        assert state.gap == pytest.approx(elastic.gap, abs=1e-8 * elastic.depth, nan_ok=True)
        assert state.mean_gap == pytest.approx(elastic.mean_gap, rel=1e-7)
        assert state.stiffness / SOLID.instantaneous == pytest.approx(elastic.stiffness / modulus, rel=1e-7)
        assert state.solution.missing == elastic.missing
        assert state.nominal_pressure == pytest.approx(elastic.nominal_pressure, rel=1e-12)
    area = [state.contact_area for state in states[1:]]
    assert np.all(np.diff(area) >= 0)
    assert area[-1] > 1.5 * area[0]


def test_a_held_squeeze_changes_no_gap_while_the_force_relaxes():
    depth = 0.5 * rc.press(PERIODIC, 1.0, force=0.02).depth
    states = path(PERIODIC, times=[0, 1, 200], depths=[0, depth, depth], tolerance=1e-10, **SOFT)
    held = [state for state in states if state.time >= 1]
    assert held[-1].force < 0.5 * held[0].force
    for state in held:
        assert state.gap == pytest.approx(held[0].gap, abs=1e-8 * depth)
    flows = [rc.gap_flow(state.solution).transmissivity for state in (held[0], held[-1])]
    assert flows[1] == pytest.approx(flows[0], rel=1e-6)


def test_the_gap_flow_of_a_state_is_that_of_its_gap():
    state = path(PERIODIC, times=[0, 3], pressures=[0.01, 0.01], steps=3)[-1]
    elastic = rc.press(PERIODIC, 1 / float(CREEP(3.0)), pressure=0.01)
    # The contact grows under the held pressure, so that the gap is that of an elastic body with 1/J(t); three steps of
    # the length of a relaxation time are accurate to a percent.
    assert state.solution.gap == pytest.approx(elastic.gap, abs=1e-2 * elastic.depth)
    flow = rc.gap_flow(state.solution)
    assert np.trace(flow.transmissivity) == pytest.approx(
        np.trace(rc.gap_flow(elastic).transmissivity), rel=3e-2
    )


def random_history(seed, surface):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 6))
    times = np.cumsum(rng.choice([0.0, 0.1, 1.0, 5.0], count))
    return times, rng.uniform(0, 1, count) * (rng.uniform(size=count) > 0.2)


@pytest.mark.parametrize("seed", range(20))
def test_work_is_stored_or_dissipated(seed):
    """In random histories with jumps, separation and return; `benchmarks/viscoelastic_energy.py` runs 200."""
    surface = (PERIODIC, FREE)[seed % 2]
    times, loads = random_history(seed, surface)
    kind, scale = (("forces", 0.03), ("depths", 0.02))[seed // 2 % 2]
    states = path(surface, times=times, **{kind: loads * scale}, **SOFT)
    work = max(state.stored_energy + state.dissipated_energy for state in states)
    for state in states:
        assert abs(state.energy_leak) <= (state.time_error + 1e-12) * work
        assert state.status.converged
        assert state.time_error <= 1e-2
    dissipated = [state.dissipated_energy for state in states]
    assert np.all(np.diff(dissipated) >= -1e-12 * max(work, 1e-300))
    assert min(state.stored_energy for state in states) >= -1e-12 * work


def test_the_leak_of_energy_is_of_second_order():
    leaks = [
        abs(path(FREE, times=[0, 1, 2], depths=[0, 0.02, 0], steps=n)[-1].energy_leak) for n in (10, 20, 40)
    ]
    # Whole cells enter and leave, so that the quotients scatter about 4.
    assert leaks[2] < leaks[0] / 8


@pytest.mark.parametrize(
    ("surface", "load", "most", "other"),
    [(FREE, "forces", 0.02, "depth"), (PERIODIC, "depths", 0.02, "force")],
)
def test_how_a_history_is_cut_changes_nothing_beyond_the_tolerance(surface, load, most, other):
    given = {"time_tolerance": 5e-3}
    whole = path(surface, times=[0, 2], **{load: [0, most]}, **given)[-1]
    shares = np.array([0, 0.15, 0.15, 0.55, 1])
    cut = path(surface, times=2 * shares, **{load: most * shares}, **given)[-1]
    assert getattr(cut, other) == pytest.approx(getattr(whole, other), rel=1e-2)  # the tolerance of each


@pytest.mark.parametrize("weight", [0.0, 1e-12])
def test_a_term_without_weight_changes_nothing(weight):
    more = rc.Viscoelastic(1.0, [2.0, 3.0, weight], [0.5, 4.0, 0.1])
    history = {"times": [0, 2], "forces": [0.01, 0.02], "steps": 4}
    for a, b in zip(path(FREE, **history), path(FREE, more, **history), strict=True):
        assert a.depth == pytest.approx(b.depth, rel=1e-9)
        assert a.stored_energy == pytest.approx(b.stored_energy, rel=1e-9)
        assert a.dissipated_energy == pytest.approx(b.dissipated_energy, rel=1e-9)


def test_the_residual_between_nodes_falls_with_the_step():
    rates = []
    for n in (10, 20, 40):
        states = path(FREE, times=[0, 1, 2], depths=[0, 0.02, 0], steps=n)
        rates.append(max(state.time_residual for state in states))
    assert rates[0] > rates[1] > rates[2] > 0
    held = path(FREE, times=[0, 0, 2], depths=[0, 0.02, 0.02], steps=2)
    assert max(state.time_residual for state in held) < 1e-9  # the open cells rest


def test_an_adaptive_step_costs_one_and_a_half_solves():
    fixed = path(FREE, times=[0, 4], forces=[0.02, 0.02], steps=40)
    adapted = path(FREE, times=[0, 4], forces=[0.02, 0.02])
    each = [float(np.mean([state.products for state in states[1:]])) for states in (fixed, adapted)]
    assert each[0] < 30
    assert each[1] < 2 * each[0]
    assert adapted[-1].time_error <= 1e-3
    assert np.isnan(fixed[-1].time_error)


def test_dashpots_are_of_first_order():
    damped = rc.Viscoelastic(equilibrium=1.0, dashpot=1.0)
    creep = damped.creep()
    depths = [
        path(FREE, damped, times=[0, 1], forces=[0.02, 0.02], steps=n, tolerance=1e-10)[-1].depth
        for n in (10, 20, 40)
    ]
    truth = rc.press(FREE, 1 / float(creep(1.0)), force=0.02, tolerance=1e-10).depth
    errors = np.abs(np.array(depths) - truth)
    assert errors[:-1] / errors[1:] == pytest.approx(2, rel=0.15)
    adapted = path(FREE, damped, times=[0, 1], forces=[0.02, 0.02], time_tolerance=0.1)
    assert adapted[0].force == 0  # the dashpot has not moved yet
    assert adapted[-1].depth == pytest.approx(truth, rel=0.1)
    assert adapted[-1].stiffness == np.inf
    assert abs(adapted[-1].energy_leak) < 0.1 * adapted[-1].work


@pytest.mark.parametrize(
    ("load", "other", "tolerance"), [("forces", "depth", 0.1), ("depths", "force", 0.05)]
)
def test_a_dashpot_meets_one_cell_after_another(load, other, tolerance):
    """At each cell the pressure jumps, and at the start all is of the order of its error: steps pass over both."""
    damped = rc.Viscoelastic(equilibrium=1.0, dashpot=1.0)
    history = {"times": [0, 1, 2], load: [0, 0.02, 0.01]}
    states = path(FREE, damped, **history, time_tolerance=tolerance)
    assert len(states) < 100
    fine = path(FREE, damped, **history, steps=60)
    wanted = [getattr(state, other) for state in fine if state.prescribed]
    found = [getattr(state, other) for state in states if state.prescribed]
    assert found == pytest.approx(wanted, abs=tolerance * max(wanted))
    assert 0 < states[-1].time_error <= tolerance


def test_a_fluid_is_pressed_until_a_period_is_full():
    fluid = rc.viscoelastic.maxwell(1.0, 1.0)
    states = path(PERIODIC, fluid, times=[0, 1e3], pressures=[0.01, 0.01], time_tolerance=1e-2)
    assert states[-1].contact_fraction == 1
    assert states[-1].status.converged
    # In full contact no pressure moves the mean, so that the depth stays at the mean separation.
    assert states[-1].depth == pytest.approx(states[-1].solution.problem.mean_separation, rel=1e-9)
    assert states[-1].relaxed_stiffness == 0
    assert np.ptp(states[-1].pressure) < 1e-6 * 0.01 + np.ptp(states[0].pressure)


def test_numbers_of_a_step():
    numbers = Transition.of(SOLID, 2.0, 0.25)
    assert numbers.modulus == pytest.approx(
        0.5 + (1 - np.exp(-0.5)) / 0.5 + 1.5 * (1 - np.exp(-0.0625)) / 0.0625
    )
    # A pressure after which the strain has grown by 1, uniformly from rest, beside many small steps.
    small = Transition.of(SOLID, 2.0, 0.25 / 1000)
    state, mean, lost, middle = np.zeros(3), 0.0, 0.0, 0.0
    for k in range(1000):
        pressure = 1e-3 + state[0] - small.past @ state  # over the modulus of the step
        every = np.append(state, pressure)
        mean += small.mean_force(every) / 1000
        lost += small.dissipated(np.outer(every, every))
        state = small.matrix @ every
        middle = pressure * small.modulus if k == 499 else middle
    every = np.array([0.0, 0.0, 0.0, 1.0])
    assert numbers.matrix @ every == pytest.approx(state, rel=1e-9)
    assert numbers.mean_force(every) == pytest.approx(mean, rel=1e-9)
    assert numbers.dissipated(np.outer(every, every)) == pytest.approx(lost, rel=1e-9)
    assert numbers.middle @ every == pytest.approx(middle, rel=1e-9)
    work = mean
    assert numbers.stored(np.outer(state, state)) + lost == pytest.approx(work, rel=1e-9)
    # Series and closed form of the dissipation agree where they meet.
    near = [Transition(np.ones(1), np.array([x]), 0.0, 0.0) for x in (0.0099999, 0.0100001)]
    squared = np.diag([0.0, 0.0, 1.0])
    assert near[0].dissipated(squared) == pytest.approx(near[1].dissipated(squared), rel=3e-5)


def test_the_dynamic_stiffness_lies_between_relaxed_and_instantaneous():
    state = path(FREE, times=[0, 1], forces=[0.01, 0.01], steps=2)[-1]
    assert state.dynamic_stiffness(0.0) == pytest.approx(state.relaxed_stiffness)
    assert state.dynamic_stiffness(1e9) == pytest.approx(state.stiffness, rel=1e-6)
    assert state.dynamic_stiffness(1.0).imag > 0
    with pytest.raises(rc.InputError, match="frequency"):
        state.dynamic_stiffness(-1.0)


def test_a_curve_is_tabulated_and_written(tmp_path):
    curve = rc.viscoelastic_curve(
        FREE,
        SOLID,
        times=[0, 0, 3],
        forces=[0, 0.01, 0.01],
        steps=3,
        measures=[lambda solution: {"edge": solution.edge_share}],
    )
    assert len(curve) == 5
    assert curve.measured["edge"].shape == (5,)
    data = curve.to_dataset()
    assert data["relaxed_stiffness"].attrs["units"] == "N m-1"
    assert data["edge"].dims == ("time",)
    rc.write(curve, tmp_path / "curve.nc")
    with xarray.open_dataset(tmp_path / "curve.nc", engine="h5netcdf", decode_timedelta=False) as read:
        assert read["depth"].to_numpy() == pytest.approx(curve.depth)
        assert read["time"].to_numpy() == pytest.approx(curve.time)
    rc.write(curve, tmp_path / "curve.csv")
    lines = (tmp_path / "curve.csv").read_text().splitlines()
    assert lines[0].startswith("time [s],force [N]")
    assert len(lines) == 6
    axes = curve.plot(quantities=("force", "mean_gap"))
    assert axes.get_xscale() == "log"
    with pytest.raises(rc.InputError, match="no column"):
        curve.plot(quantities=("status", "depth"))


DAMPED = rc.viscoelastic.kelvin_voigt(1.0, 1.0)
MEASURED = rc.Viscoelastic(1.0, (2.0,), (1.0,), band=(1e-2, 1e2))


@pytest.mark.parametrize(
    ("words", "wrong", "right"),
    [
        ("must not decrease", {"times": [0, 2, 1]}, {"times": [0, 1, 2]}),
        ("one time for each load", {"times": [0, 1]}, {"times": [0, 1, 2]}),
        ("times must be finite", {"times": [0, 1, np.inf]}, {"times": [0, 1, 1e6]}),
        ("forces must not be negative", {"forces": [0, 0.01, -0.01]}, {"forces": [0, 0.01, 0]}),
        (
            "exactly one of",
            {"depths": [0, 1e-3, 0]},
            {"forces": None, "depths": [0, 1e-3, 0]},
        ),
        ("time_tolerance", {"time_tolerance": 1e-8}, {"time_tolerance": 1e-2}),
        ("exceeds the mean separation", {"forces": None, "depths": [0, 1, 0]}, {"forces": [0, 1, 0]}),
        (
            "the depth jumps",
            {"material": DAMPED, "forces": None, "times": [0, 1, 1], "depths": [0, 0, 1e-3]},
            {"material": DAMPED, "forces": None, "times": [0, 1, 2], "depths": [0, 0, 1e-3]},
        ),
        ("a viscoelastic material is needed", {"material": 1e6}, {}),
        (
            "lasts 1000 s, and the data of the material end at 100 s",
            {"material": MEASURED, "times": [0, 1, 1000]},
            {"material": MEASURED, "times": [0, 1, 100]},
        ),
        ("steps must be a whole number", {"steps": 0}, {"steps": 1}),
        (
            "reduced modulus",
            {"operator": rc.half_space(PERIODIC.grid, 1.0)},
            {"operator": rc.half_space(PERIODIC.grid, SOLID.instantaneous)},
        ),
    ],
)
def test_bad_input_is_refused_at_the_call(words, wrong, right):
    good = {"material": SOLID, "times": [0, 1, 2], "forces": [0, 0.01, 0.005], "steps": 1}
    with pytest.raises(rc.InputError, match=re.escape(words)):
        rc.viscoelastic_path(PERIODIC, **(good | wrong))
    assert next(rc.viscoelastic_path(PERIODIC, **(good | right))).status.converged


@pytest.mark.parametrize("parameter", [{"hardness": 1.0}, {"adhesion": 1.0}])
def test_neither_hardness_nor_adhesion_is_a_parameter(parameter):
    with pytest.raises(TypeError, match="unexpected keyword"):
        rc.viscoelastic_path(PERIODIC, SOLID, times=[0, 1], forces=[0, 0.01], **parameter)
