"""Derivatives with respect to parameters: rms height, radius, tilt, load, modulus, a parameter of the operator."""

import numpy as np
import pint
import pytest

import roughcontact as rc
from perturbed import CASES, MODULUS, STEP, TOLERANCE, Case, pressed, uncertainty

VALUES = {"force": "force", "depth": "depth", "mean_gap": "mean_gap", "energy": "elastic_energy"}


def check(state, found, states, step):
    """Compare with a central difference: `states` returns the two loads at what is held.

    A relative step of 1e-6 leaves 1e-12 of the third derivative, and rounding is that of depths.
    """
    scales = {"force": state.stiffness, "depth": 1.0, "mean_gap": 2.0, "energy": 2 * state.force}
    pairs = {held: states(held) for held in {quantity.partition("_at_")[2] for quantity in found}}
    for quantity, value in found.items():
        name, _, held = quantity.partition("_at_")
        forth, back = pairs[held]
        assert np.array_equal(forth.contact, back.contact)
        allowed = scales[name] * sum(map(uncertainty, (forth, back))) / (2 * step)
        difference = (getattr(forth, VALUES[name]) - getattr(back, VALUES[name])) / (2 * step)
        assert difference == pytest.approx(value, abs=allowed, rel=1e-10), quantity


def with_heights(case, state, heights_at, step):
    def states(held):
        for sign in (1, -1):
            body = case.body.__class__(heights_at(sign * step), case.body.grid)
            yield pressed(case, body, **{held: getattr(state, held)})

    return lambda held: list(states(held))


@pytest.mark.parametrize("name", ["free", "periodic, cells missing", "line", "unequal rings"])
def test_rms_height(name):
    case = CASES[name]()
    state, heights = pressed(case), case.body.heights
    weights = np.broadcast_to(state.problem.operator.weights, heights.shape) * np.isfinite(heights)
    mean = np.nansum(weights * heights) / weights.sum()
    rms = np.sqrt(np.nansum(weights * (heights - mean) ** 2) / weights.sum())
    step = STEP * rms
    scaled = with_heights(case, state, lambda change: mean + (heights - mean) * (1 + change / rms), step)
    check(state, rc.sensitivity(state).to_rms_height(), scaled, step)
    # Scaled as the note has it: the force at a depth is homogeneous.
    expected = (state.force - state.stiffness * state.depth) / rms
    assert rc.sensitivity(state).to_rms_height()["force_at_depth"] == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize(
    ("name", "axis"), [("free", 0), ("unequal sides, not square", 1), ("singly periodic", 1), ("line", 0)]
)
def test_tilt(name, axis):
    case = CASES[name]()
    state, grid = pressed(case), case.body.grid
    x = grid.coordinates[axis] - grid.coordinates[axis].mean()
    x = x.reshape([-1 if each == axis else 1 for each in range(grid.ndim)])
    step = STEP * np.nanstd(case.body.heights) / x.max()
    tilted = with_heights(case, state, lambda slope: case.body.heights + slope * x, step)
    check(state, rc.sensitivity(state).to_tilt(axis), tilted, step)


def test_what_cannot_be_tilted():
    for name, axis in (("periodic", 0), ("singly periodic", 0), ("unequal rings", 0)):
        with pytest.raises(rc.InputError, match="a periodic or axisymmetric surface cannot be tilted: give"):
            rc.sensitivity(pressed(CASES[name]())).to_tilt(axis)
    with pytest.raises(rc.InputError, match=r"the axis must be one of \(0,\), not 1"):
        rc.sensitivity(pressed(CASES["line"]())).to_tilt(1)


def ball(cells, radius=1.0):
    return rc.shapes.paraboloid(rc.Grid((cells, cells), 0.25 / cells), radius=radius)


@pytest.mark.parametrize("cells", [32, 33])
def test_radius(cells):
    """The centre lies between cells or on one: the derivatives from first touch are those at a fixed apex."""
    body = ball(cells)
    case = Case(body, {}, 1e-3)
    state = pressed(case)
    heights = with_heights(case, state, lambda change: ball(cells, 1 + change).heights, STEP)
    if cells % 2:  # an only highest cell
        check(state, rc.sensitivity(state).to_radius(1.0), heights, STEP)
    else:
        with pytest.raises(rc.InputError, match="4 cells share the greatest height"):
            rc.sensitivity(state).to_radius(1.0)
        found = rc.sensitivity(state, reference="level").to_radius(1.0)
        del found["depth_at_force"]  # the highest cells move in the differences
        found = {name: value for name, value in found.items() if name.endswith("force")}
        check(state, found, heights, STEP)


def test_the_radius_of_hertz():
    """At a fixed level F goes as the root of R: on a staircase to some per cent, by refinement; here within 4 %."""
    errors = []
    for cells in (32, 64, 96):
        state = rc.press(ball(cells), MODULUS, force=1e-3, tolerance=1e-10)
        found = rc.sensitivity(state, reference="level").to_radius(1.0)["force_at_depth"]
        errors.append(found / (0.5 * state.force) - 1)
    assert abs(errors[-1]) < 0.04
    assert max(map(abs, errors)) < 0.08  # a ring of cells, of some ten in the radius, more or less


def test_a_radius_with_a_unit():
    found = rc.sensitivity(rc.press(ball(33), MODULUS, force=1e-3))
    units = pint.get_application_registry()
    assert found.to_radius(units.Quantity(1000.0, "mm")) == found.to_radius(1.0)
    for wrong in (0.0, -1.0, "1 m", units.Quantity(1.0, "N")):
        with pytest.raises(rc.InputError, match="radius"):
            found.to_radius(wrong)


@pytest.mark.parametrize("name", CASES)
def test_load(name):
    case = CASES[name]()
    state = pressed(case)
    found = rc.sensitivity(state).to_load()
    for held in ("force", "depth"):
        value = getattr(state, held)
        step = STEP * value
        pairs = [pressed(case, **{held: value + sign * step}) for sign in (1, -1)]
        # "depth_at_force" is the change of the depth with the force.
        kept = {quantity: each for quantity, each in found.items() if quantity.endswith(held)}
        check(state, kept, lambda _, pairs=pairs: pairs, step)
    assert found["force_at_depth"] == pytest.approx(state.stiffness, rel=1e-9)


@pytest.mark.parametrize("name", ["free", "periodic", "unequal rings"])
def test_modulus(name):
    case = CASES[name]()
    state = pressed(case)

    def states(held):
        for sign in (1, -1):
            yield rc.press(
                case.body, MODULUS + sign * STEP, tolerance=TOLERANCE, **{held: getattr(state, held)}
            )

    check(state, rc.sensitivity(state).to_modulus(), lambda held: list(states(held)), STEP)


def test_the_modulus_of_a_body_of_several():
    """All moduli of a layer grow alike."""
    case = CASES["bonded layer"]()
    state = pressed(case)

    def states(held):
        for sign in (1, -1):
            solid = rc.Solid(1.0 + sign * STEP, 0.45)
            options = {"operator": rc.layer(case.body.grid, solid, 0.1, base="bonded")}
            yield pressed(Case(case.body, options, case.force), **{held: getattr(state, held)})

    check(state, rc.sensitivity(state).to_modulus(), lambda held: list(states(held)), STEP)


def test_what_has_no_derivative_by_a_modulus():
    hard = rc.press(CASES["free"]().body, MODULUS, force=0.01, hardness=0.09)
    with pytest.raises(rc.InputError, match="not proportional to the modulus"):
        rc.sensitivity(hard).to_modulus()
    with pytest.raises(rc.InputError, match="the load has no hardness: press with hardness="):
        rc.sensitivity(pressed(CASES["free"]())).to_hardness()


def test_a_parameter_of_the_operator():
    """The change of the displacement at a fixed pressure acts as if the surface were lowered by it.

    Of the energy at a fixed level this is twice the change: half of it is the operator's own.
    """
    case = CASES["bonded layer"]()
    state = pressed(case)

    def layer(thickness):
        return rc.layer(case.body.grid, rc.Solid(1.0, 0.45), thickness, base="bonded")

    step = 1e-5  # of a thickness of 0.1: 1e-8 of it are left of the third derivative
    change = (layer(0.1 + step).apply(state.pressure) - layer(0.1 - step).apply(state.pressure)) / (2 * step)
    found = rc.sensitivity(state, reference="level").along(-change)
    half = 0.5 * (state.problem.operator.weights * state.pressure * change).sum()
    for quantity, correction in (("energy_at_depth", half), ("energy_at_force", half)):
        found[quantity] += correction
    thicker, thinner = (
        Case(case.body, {"operator": layer(0.1 + sign * step)}, case.force) for sign in (1, -1)
    )
    states = {
        held: [pressed(each, **{held: getattr(state, held)}) for each in (thicker, thinner)]
        for held in ("force", "depth")
    }
    for quantity, value in found.items():
        name, _, held = quantity.partition("_at_")
        forth, back = states[held]
        assert np.array_equal(forth.contact, back.contact)
        difference = (getattr(forth, VALUES[name]) - getattr(back, VALUES[name])) / (2 * step)
        assert difference == pytest.approx(value, rel=1e-6), quantity


def test_secant_stiffness():
    case, rng = CASES["free"](), np.random.default_rng(3)
    loads = [case.force, 1.15 * case.force]

    def secant(heights):
        body = rc.Surface(heights, case.body.grid)
        first, second = (rc.sensitivity(pressed(case, body, force=load)) for load in loads)
        return first, second, first.secant_stiffness(second)

    first, second, (value, derivative) = secant(case.body.heights)
    lower, upper = first.solution.stiffness, second.solution.stiffness
    assert lower < value < upper
    direction, step = rng.normal(size=derivative.shape), STEP * case.body.heights.std()
    states = [secant(case.body.heights + sign * step * direction) for sign in (1, -1)]
    for index in (0, 1):
        assert np.array_equal(states[0][index].solution.contact, states[1][index].solution.contact)
    difference = (states[0][2][0] - states[1][2][0]) / (2 * step)
    # Both depths are rounded, and their difference is divided by.
    rounding = sum(uncertainty(each.solution) for state in states for each in state[:2]) / (2 * step)
    approach = second.solution.depth - first.solution.depth
    assert difference == pytest.approx((derivative * direction).sum(), abs=value / approach * rounding)
    with pytest.raises(rc.InputError, match="has the same depth as this load"):
        first.secant_stiffness(first)
    with pytest.raises(rc.InputError, match=r"other is a Solution: give sensitivity\(solution\)"):
        first.secant_stiffness(second.solution)
    with pytest.raises(rc.InputError, match="is a load on another grid"):
        first.secant_stiffness(rc.sensitivity(pressed(CASES["unequal sides, not square"]())))
