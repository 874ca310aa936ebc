"""Curves as functions of heights: values are those of a curve, and derivatives those of its numbers."""

import numpy as np
import pytest

import roughcontact as rc
from libraries import LIBRARIES
from perturbed import CASES, MODULUS, STEP, TOLERANCE, uncertainty
from roughcontact.gradients import differentiable

FREE, RINGS = CASES["free"](), CASES["unequal rings"]()
DEPTHS = np.array([0.004, 0.006, 0.009])
TOP = FREE.body.heights.max()
KINDS = {
    "forces": (FREE, {"forces": [1e-3, 2e-3, 4e-3]}),
    "forces from a level": (FREE, {"forces": [1e-3, 2e-3], "reference": "level"}),
    "depths": (FREE, {"depths": DEPTHS}),
    "depths from a level": (FREE, {"depths": DEPTHS - TOP, "reference": "level"}),
    "pressures": (FREE, {"pressures": [1e-3, 2e-3]}),
    "rings": (RINGS, {"forces": [5e-3, 1e-2]}),
    "hardness": (FREE, {"forces": [4e-3, 1e-2], "hardness": 0.09}),
    "layer": (
        FREE,
        {"forces": [2e-3], "operator": rc.layer(FREE.body.grid, rc.Solid(1.0, 0.45), 0.1, base="bonded")},
    ),
}


def made(name, **changed):
    case, given = KINDS[name]
    return case.body, rc.differentiable_curve(
        case.body.grid, MODULUS, **({"tolerance": TOLERANCE} | given | changed)
    )


@pytest.mark.parametrize("name", KINDS)
def test_values_are_those_of_a_path(name):
    body, curve = made(name)
    values, _ = curve.linearise(body.heights)
    given = {key: value for key, value in KINDS[name][1].items() if key != "reference"}
    level = TOP if "level" in name else 0.0
    if "depths" in given:
        given["depths"] = np.add(given["depths"], level)
    path = list(rc.loading_path(body, MODULUS, tolerance=TOLERANCE, **given))
    for quantity, attribute in zip(
        values._fields, ("force", "depth", "mean_gap", "elastic_energy"), strict=True
    ):
        expected = np.array([getattr(state, attribute) for state in path])
        expected = expected - level if quantity == "depth" else expected
        np.testing.assert_allclose(getattr(values, quantity), expected, rtol=1e-12, err_msg=quantity)


@pytest.mark.parametrize("name", KINDS)
def test_misfits(name):
    """The derivative of a misfit of each quantity, in a random direction."""
    body, curve = made(name)
    direction = np.random.default_rng(4).normal(size=body.grid.shape)
    step = STEP * body.heights.std()
    values, pullback = curve.linearise(body.heights)
    forth, back = (curve.linearise(body.heights + sign * step * direction)[0] for sign in (1, -1))
    state = rc.press(body, MODULUS, force=values.force[-1], tolerance=TOLERANCE)
    # Of a depth, as in the differences of single loads; a lower residual than this is not to be had.
    unit = 2 * uncertainty(state) / (2 * step)
    stiffness = 2 * np.abs(values.force).max() / np.abs(values.depth + (TOP if "level" in name else 0)).min()
    scales = {"force": stiffness, "depth": 1.0, "mean_gap": 2.0, "energy": 2 * values.force.max()}
    for quantity, scale in scales.items():
        if quantity == "energy" and name == "hardness":
            with pytest.raises(rc.InputError, match="elastic energy has no derivative"):
                pullback(energy=1.0)
            continue
        now = getattr(values, quantity)
        weights = now - 1.1 * now.mean()  # of half a sum of squares
        found = (pullback(**{quantity: weights}) * direction).sum()
        difference = (weights * (getattr(forth, quantity) - getattr(back, quantity))).sum() / (2 * step)
        if np.array_equal(getattr(forth, quantity), getattr(back, quantity)):
            assert found == difference == 0  # given
        assert difference == pytest.approx(found, abs=np.abs(weights).sum() * scale * unit), quantity


def test_several_quantities_add_up():
    body, curve = made("forces")
    _, pullback = curve.linearise(body.heights)
    both = pullback(depth=[1.0, 0.0, 2.0], mean_gap=3.0)
    apart = pullback(depth=[1.0, 0.0, 2.0]) + pullback(mean_gap=[3.0, 3.0, 3.0])
    np.testing.assert_allclose(both, apart, rtol=0, atol=8 * np.finfo(float).eps * np.abs(both).max())
    assert not pullback().any()
    assert not pullback(force=1.0).any()  # given


@pytest.mark.parametrize("library", LIBRARIES, ids=lambda kind: kind.__name__)
def test_arrays_of_other_libraries_are_copied(library):
    body, curve = made("forces from a level")
    values, pullback = curve.linearise(body.heights)
    copied, from_copied = curve.linearise(library.put(body.heights.copy()))
    np.testing.assert_array_equal(copied.depth, values.depth)
    np.testing.assert_array_equal(from_copied(depth=1.0), pullback(depth=1.0))


def test_missing_cells():
    case = CASES["periodic, cells missing"]()
    curve = rc.differentiable_curve(case.body.grid, MODULUS, forces=[5e-3, 1e-2])
    values, pullback = curve.linearise(case.body.heights)
    gradient = pullback(depth=1.0)
    assert np.isfinite(values.depth).all()
    assert np.isnan(case.body.heights).any()
    assert not gradient[np.isnan(case.body.heights)].any()


def test_what_is_refused():
    body, curve = made("forces")
    _, pullback = curve.linearise(body.heights)
    with pytest.raises(TypeError, match="unexpected keyword argument 'area'"):
        pullback(area=1.0)
    with pytest.raises(rc.InputError, match=r"depth has the shape \(2,\), the loads \(3,\)"):
        pullback(depth=[1.0, 2.0])
    with pytest.raises(rc.InputError, match="derivative with respect to depth must be a number"):
        pullback(depth="all")
    with pytest.raises(rc.InputError, match=r"the heights have the shape \(3, 3\)"):
        curve.linearise(np.zeros((3, 3)))
    with pytest.raises(rc.InputError, match="the forces must increase strictly"):
        made("forces", forces=[2e-3, 1e-3])
    with pytest.raises(rc.InputError, match="give exactly one of forces, depths and pressures"):
        made("forces", depths=DEPTHS)
    with pytest.raises(rc.InputError, match="must be 'first touch' or 'level', not 'top'"):
        made("forces", reference="top")
    with pytest.raises(rc.InputError, match="the grid must be a Grid or a RadialGrid, not 1e-06"):
        rc.differentiable_curve(1e-6, MODULUS, forces=[1.0])
    _, from_level = made("depths from a level", depths=[-2 * TOP, TOP])
    with pytest.raises(rc.InputError, match=f"at {-2 * TOP:g} m no cell touches; give more than {-TOP:g} m"):
        from_level.linearise(body.heights)


def test_a_load_that_misses_its_tolerance(monkeypatch):
    body, curve = made("forces")

    def missed(*_):
        with pytest.raises(rc.ConvergenceError) as caught:
            rc.press(body, MODULUS, force=0.02, solver=rc.PolonskyKeer(max_steps=3))
        return [caught.value.solution]

    monkeypatch.setattr(differentiable, "solutions_along", missed)
    with pytest.raises(rc.ConvergenceError):
        curve.linearise(body.heights)
