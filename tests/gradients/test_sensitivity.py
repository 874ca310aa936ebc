"""What has derivatives and what has none, arrays of all kinds, and the number of products."""

import numpy as np
import pytest

import products
import roughcontact as rc
from libraries import LIBRARIES
from perturbed import CASES, MODULUS, pressed
from products import Task, count
from slabs.together import together

QUANTITIES = (
    *("force_at_depth", "depth_at_force", "mean_gap_at_force", "mean_gap_at_depth"),
    *("energy_at_force", "energy_at_depth", "share"),
)
AGREEMENT = 1e-9  # of the largest entry: both are solved to 1e-10, and the derivatives to ten times that


def load(heights, case):
    return rc.press(rc.Surface(heights, case.body.grid), MODULUS, force=case.force, tolerance=1e-10)


def agree(found, expected):
    np.testing.assert_allclose(found, expected, rtol=0, atol=AGREEMENT * np.abs(expected).max())


@pytest.mark.parametrize("library", LIBRARIES, ids=lambda kind: kind.__name__)
@pytest.mark.parametrize("name", ["free", "periodic, cells missing"])
def test_arrays_of_other_libraries(name, library):
    case = CASES[name]()
    here = rc.sensitivity(load(case.body.heights, case))
    heights = library.put(case.body.heights.copy())
    there = rc.sensitivity(load(heights, case))
    for quantity in QUANTITIES:
        found = getattr(there, quantity)
        assert library.is_there(found), quantity
        agree(library.get(found), getattr(here, quantity))
    gap = there.solution.gap**3
    agree(library.get(there.pullback(gap=gap)), here.pullback(gap=here.solution.gap**3))
    numbers = {
        "along": lambda found, field: found.along(field),
        "rms height": lambda found, _: found.to_rms_height(),
        "radius": lambda found, _: found.to_radius(1.0),
        "load": lambda found, _: found.to_load(),
        "modulus": lambda found, _: found.to_modulus(),
    }
    if name == "free":
        numbers["tilt"] = lambda found, _: found.to_tilt(1)
    for name, call in numbers.items():
        expected = call(here, case.body.heights)
        scale = max(map(abs, expected.values()))
        assert call(there, heights) == pytest.approx(expected, rel=1e-6, abs=AGREEMENT * scale), name
    assert there.notes == here.notes
    with pytest.raises(rc.InputError, match=r"direction must be a .* like the heights, not a ndarray"):
        there.along(case.body.heights)
    assert here.along(case.body.heights.tolist()) == here.along(case.body.heights)


@pytest.mark.parametrize("name", ["periodic", "periodic, cells missing"])
def test_arrays_in_slabs(name):
    case = CASES[name]()
    here = rc.sensitivity(load(case.body.heights, case))

    def work(communicator):
        slabs = rc.Slabs(communicator)
        mine = slabs.array(case.body.heights[slabs.rows(case.body.grid.shape[0])])
        there = rc.sensitivity(load(mine, case))
        fields = [getattr(there, quantity).gathered() for quantity in QUANTITIES]
        pulled = there.pullback(gap=there.solution.gap).gathered()
        with pytest.raises(rc.InputError, match="direction must be a SlabArray like the heights"):
            there.along(case.body.heights)
        return fields, pulled, there.along(mine), there.to_rms_height()

    for fields, pulled, along, height in together(2, work):
        for quantity, field in zip(QUANTITIES, fields, strict=True):
            agree(field, getattr(here, quantity))
        agree(pulled, here.pullback(gap=here.solution.gap))
        assert along == pytest.approx(here.along(case.body.heights), rel=1e-6, abs=1e-9)
        assert height == pytest.approx(here.to_rms_height(), rel=1e-6, abs=1e-9)


# Products.


@pytest.mark.parametrize("periodic", [False, True])
def test_derivatives_take_no_product_beyond_those_of_the_stiffness(periodic):
    """A thousand cells in contact, so that the tangent is iterated."""
    plane = products.plane(128, periodic=periodic)

    def fields(found):
        _ = found.force_at_depth, found.depth_at_force, found.energy_at_force, found.energy_at_depth

    def gaps(found):
        return found.mean_gap_at_force

    stiffness = taken(plane, lambda solution: solution.stiffness)
    assert taken(plane, lambda solution: fields(rc.sensitivity(solution))) == stiffness
    assert stiffness.products > taken(plane, lambda solution: None).products
    # The mean gap takes the operator's mean, one product, and a linear problem like that of the stiffness; on a period
    # without missing cells no pressure moves the mean.
    assert (taken(plane, lambda solution: gaps(rc.sensitivity(solution))) == stiffness) == periodic


def taken(plane, work, tolerance=1e-8):
    """Return what a load and work on it take."""
    surface, operator = plane

    def run(operator):
        work(rc.press(surface, 1.0, force=100.0, tolerance=tolerance, operator=operator))

    return count(Task(run, operator))


def test_those_of_a_curve_take_no_product_beyond_its_stiffnesses():
    surface, operator = products.plane(64, periodic=True)
    forces = [2.0, 4.0, 8.0, 16.0, 32.0]

    def stiffnesses(operator):
        return [each.stiffness for each in rc.loading_path(surface, 1.0, forces=forces, operator=operator)]

    def differentiated(operator):
        curve = rc.differentiable_curve(surface.grid, 1.0, forces=forces, operator=operator)
        _, pullback = curve.linearise(surface.heights)
        return pullback(depth=1.0, mean_gap=1.0, energy=1.0)

    assert count(Task(differentiated, operator)) == count(Task(stiffnesses, operator))


def test_a_load_more_accurate_than_its_stiffness_takes_more():
    """The tangent is improved from where it stands: at most twice as much again."""
    plane = products.plane(128, periodic=True)
    works = (
        lambda _: None,
        lambda solution: solution.stiffness,
        lambda solution: rc.sensitivity(solution).share,
    )
    bare, stiffness, better = (taken(plane, work, 1e-12).products for work in works)
    assert stiffness < better <= stiffness + 2 * (stiffness - bare)


# Names.


FOUND = rc.sensitivity(pressed(CASES["free"]()))


@pytest.mark.parametrize("held", ["", "_at_force", "_at_depth"])
@pytest.mark.parametrize(
    ("name", "words"),
    [
        (
            "contact_area",
            "the contact area changes in steps, so it has no derivative; no other number stands",
        ),
        ("contact_fraction", "the contact area changes in steps"),
        ("spots", "the number of spots changes in steps, so it has no derivative; no other number stands"),
        ("stiffness", "the stiffness changes in steps, so it has no derivative: use secant_stiffness"),
    ],
)
def test_what_changes_in_steps_is_refused_by_name(name, held, words):
    with pytest.raises(AttributeError, match=f"no attribute '{name}{held}': on a grid {words}"):
        getattr(FOUND, name + held)


@pytest.mark.parametrize("name", ["sensitivity", "gradient", "derivatives"])
def test_answers_say_where_their_derivatives_are(name):
    curve = rc.loading_curve(CASES["free"]().body, MODULUS, forces=[1e-3, 2e-3])
    for answer in (FOUND.solution, curve):
        with pytest.raises(
            AttributeError, match=rf"no attribute '{name}'; did you mean rc.sensitivity\(solution\)"
        ):
            getattr(answer, name)
    if name != "sensitivity":
        with pytest.raises(AttributeError, match=r"did you mean rc\.sensitivity"):
            getattr(rc, name)


def test_a_sensitivity_is_written_in_a_line():
    assert repr(FOUND).startswith("Sensitivity(reference='first touch', Solution(converged, force 0.002 N,")
    assert FOUND.residual <= 1e-12
