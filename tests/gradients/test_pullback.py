"""Reverse mode: nonlinear scalars of pressure, displacement and gap against central differences."""

import numpy as np
import pytest

import roughcontact as rc
from perturbed import CASES, EPS, pair, pressed, single, uncertainty

# A scalar by its terms for each measured cell, with its derivatives with respect to the fields; open cells have a gap.
SCALARS = {
    "pressure squared": lambda s: (s.pressure**2, {"pressure": 2 * s.pressure}),
    "gap cubed": lambda s: (gap_of(s) ** 3, {"gap": 3 * gap_of(s) ** 2}),
    "displacement squared": lambda s: (displaced(s) ** 2, {"displacement": 2 * s.displacement}),
    "all of them": lambda s: (
        s.pressure * s.displacement + gap_of(s) * s.displacement,
        {"pressure": s.displacement, "displacement": s.pressure + gap_of(s), "gap": s.displacement},
    ),
}


def displaced(state):
    return np.where(np.isnan(state.gap), 0.0, state.displacement)


def gap_of(state):
    return np.where(state.contact | np.isnan(state.gap), 0.0, state.gap)


@pytest.mark.parametrize("held", ["force", "depth"])
@pytest.mark.parametrize("scalar", SCALARS)
@pytest.mark.parametrize(
    "name", ["free", "periodic, cells missing", "periodic layer", "line", "unequal rings"]
)
def test_scalars(name, scalar, held):
    """The bound is that of a depth, times all that the scalar can change by; and the rounding of its own sum."""
    case, rng = CASES[name](), np.random.default_rng(5)
    state = pressed(case)
    found = rc.sensitivity(state)
    terms, fields = SCALARS[scalar](state)
    gradient, level = (
        rc.sensitivity(state, reference=each).pullback(**fields, held=held)
        for each in ("first touch", "level")
    )
    assert not gradient[~np.isfinite(state.problem.separation)].any()
    reach = np.abs(gradient).sum() + np.abs(level).sum() + np.abs(fields.get("gap", 0.0)).sum()
    for direction in (single(case, np.argwhere(state.contact)[2]), rng.normal(size=terms.shape)):
        forth, back, step = pair(case, direction, **{held: getattr(state, held)})
        difference = (SCALARS[scalar](forth)[0].sum() - SCALARS[scalar](back)[0].sum()) / (2 * step)
        allowed = reach * sum(map(uncertainty, (forth, back))) + 8 * EPS * np.abs(terms).sum()
        tangent = 10 * found.residual * np.abs(gradient * direction).sum()
        assert difference == pytest.approx((gradient * direction).sum(), abs=allowed / (2 * step) + tangent)


def test_the_force_is_a_scalar_too():
    """With the weights as derivatives the force comes back: its derivative at a depth, and none at a force."""
    state = pressed(CASES["unequal rings"]())
    found, weights = rc.sensitivity(state), state.problem.operator.weights
    at_depth, at_force = (found.pullback(pressure=weights, held=held) for held in ("depth", "force"))
    largest = abs(found.force_at_depth).max()
    np.testing.assert_allclose(at_depth, found.force_at_depth, rtol=0, atol=1e-11 * largest)
    np.testing.assert_allclose(at_force, 0.0, rtol=0, atol=1e-11 * largest)


def test_nothing_given_has_no_derivative():
    state = pressed(CASES["free"]())
    assert not rc.sensitivity(state).pullback().any()


def test_wrong_fields_are_refused():
    found = rc.sensitivity(pressed(CASES["free"]()))
    with pytest.raises(rc.InputError, match=r"gap has the shape \(3,\), the grid \(48, 48\)"):
        found.pullback(gap=np.zeros(3))
    with pytest.raises(rc.InputError, match="pressure must be finite for every measured cell"):
        found.pullback(pressure=np.full((48, 48), np.nan))
    with pytest.raises(rc.InputError, match="displacement must be a number or an array of numbers"):
        found.pullback(displacement="all")
    with pytest.raises(rc.InputError, match="held must be 'force' or 'depth', not 'gap'"):
        found.pullback(held="gap")
