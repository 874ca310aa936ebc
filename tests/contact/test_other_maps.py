"""How much another map of a surface would differ: from four quarters of one, or a sentence."""

import json
import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.evaluation.error_budget import ErrorBudget, ErrorSource, QuotedNumber
from roughcontact.evaluation.error_notes import REMEDIES, notes_on_sources
from roughcontact.evaluation.error_numbers import NUMBERS
from roughcontact.evaluation.other_maps import LENGTHS, OF_JOINT, SPOTS, sampling_of

MODULUS, PRESSURE = 1e9, 1e6
EXACT = 1e-6  # of a number: two solves of one contact, each certified to 1e-8 of its largest displacement
CELLS = 24  # to a side of a ball's square


def rough(shape=(32, 32), *, seed=1, periodic=False):
    grid = rc.Grid(shape, 1e-6, periodic=periodic)
    waves = {"hurst": 0.8, "rolloff": 8e-6, "short_cutoff": 4e-6}
    return rc.self_affine(grid, rms=1e-7, rng=np.random.default_rng(seed), **waves)


def balls(count=16, sharp=(), cells=CELLS):
    """A map of 4 x 4 squares, the first `count` with a ball; those in `sharp` have half the radius."""
    x = np.arange(cells) - (cells - 1) / 2
    ball = -(x[:, None] ** 2 + x**2) * 1e-12 / 2e-3
    ball -= ball.max()
    tiles = [np.full_like(ball, 3 * ball.min())] * 16
    tiles[:count] = [ball * (2 if place in sharp else 1) for place in range(count)]
    heights = np.block([tiles[row : row + 4] for row in range(0, 16, 4)])
    return rc.Surface(heights, rc.Grid(heights.shape, 1e-6))


def tiled(quarter, *, periodic):
    """A map of four quarters that are alike."""
    heights = np.tile(quarter.heights, (2, 2))
    return rc.Surface(heights, rc.Grid(heights.shape, 1e-6, periodic=periodic))


def pressed(surface, pressure=PRESSURE, **named):
    return rc.press(surface, MODULUS, pressure=pressure, **named)


def relative(found, name, solution):
    return found.parts[NUMBERS.index(name)] / getattr(solution, name)


@pytest.mark.parametrize("periodic", [False, True])
def test_quarters_that_are_alike_scatter_by_nothing(periodic):
    solution = pressed(tiled(rough(periodic=periodic), periodic=periodic))
    found = sampling_of(solution)
    assert found.source.kind == "order of magnitude"
    names = [*LENGTHS, "stiffness", "interfacial_stiffness", "contact_area", "elastic_energy"]
    assert [relative(found, name, solution) for name in names] == pytest.approx([0] * len(names), abs=EXACT)
    # Alone, a quarter has no neighbours that carry with it: it differs from the whole all the same.
    assert abs(found.bias_of_size["interfacial_stiffness_per_area"]) > 1e-3


@pytest.mark.parametrize(
    ("periodic", "named"),
    [(False, {}), (True, {}), (False, {"hardness": 3e7})],
    ids=["free", "periodic", "plastic"],
)
def test_the_parts_are_those_of_quarters_pressed_alone(periodic, named):
    surface = rough((65, 48), periodic=periodic)  # of 65 rows the middle one is in no quarter
    solution = pressed(surface, **named)
    assert bool(named) == bool(solution.plastic.any())
    found = sampling_of(solution)
    quarters = [
        pressed(rc.Surface(surface.heights[rows, columns], rc.Grid((32, 24), 1e-6)), **named)
        for rows in (slice(0, 32), slice(33, 65))
        for columns in (slice(0, 24), slice(24, 48))
    ]
    names = ["depth", "stiffness", "interfacial_stiffness", "contact_area", "mean_gap", "elastic_energy"]
    for name in (*names, "contact_fraction", "interfacial_stiffness_per_area"):
        of_quarter = "interfacial_stiffness" if periodic and name == "stiffness" else name
        values = np.array([getattr(each, of_quarter) for each in quarters])
        expected = values.std(ddof=1) / values.mean() / 2
        assert relative(found, name, solution) == pytest.approx(expected, rel=1e-5)
        if name in OF_JOINT:
            bias = values.mean() / getattr(solution, name) - 1
            assert found.bias_of_size[name] == pytest.approx(bias, abs=EXACT)
    assert set(found.bias_of_size) == set(OF_JOINT)


def test_one_quarter_of_balls_of_half_the_radius_is_hertz():
    """Under one force, radii of contact are as the cube roots of those of the balls.

    1, 1, 1 and r deviate by (1 - r)/2 about (3 + r)/4, over two (1 - r)/(3 + r). For the area r = 2^(-2/3). In a square
    lattice of step s, whose Madelung constant is 3.90, a spot has 1/K = 1/(2 E a) - 3.90/(pi E s). The rims of 180
    cells in contact are known to some 7 of them, their difference, two fifths, to a tenth.
    """
    step = 48
    solution = pressed(balls(sharp=(0, 1, 4, 5), cells=step), 3e5)
    found = sampling_of(solution)
    assert solution.spots.count == 16
    radii = np.cbrt(0.75 * solution.force / 16 * 1e-3 / MODULUS * np.array([1, 0.5]))
    stiffness = 1 / (1 / (2 * radii) - 3.9002649 / math.pi / (step * 1e-6))
    for name, values in (("contact_area", radii**2), ("interfacial_stiffness", stiffness)):
        r = values[1] / values[0]
        assert relative(found, name, solution) == pytest.approx((1 - r) / (3 + r), rel=0.1), name
    assert abs(found.bias_of_size["contact_fraction"]) < 0.02  # spots far from each other


def test_a_quarter_with_missing_cells_carries_by_those_that_were_measured():
    surface = balls()
    heights = surface.heights.copy()
    heights[:CELLS, : 2 * CELLS] = np.nan  # two of the four balls of a quarter
    half = pressed(rc.Surface(heights, surface.grid), 3e4)
    found = sampling_of(half)
    assert found.source.kind == "order of magnitude"
    # By all its cells this quarter would be half as stiff as the others: (1 - 1/2)/(3 + 1/2) = 0.14.
    for name in ("interfacial_stiffness", "contact_area", "elastic_energy"):
        assert relative(found, name, half) < 0.03
    heights[0, -1] = heights[CELLS, 0] = np.nan
    less = sampling_of(pressed(rc.Surface(heights, surface.grid), 3e4))
    assert (less.source.kind, less.source.how) == (
        "unknown",
        "more than half of the heights of one quarter are missing",
    )


@pytest.mark.parametrize("count", [1, SPOTS - 1, SPOTS])
def test_below_ten_spots_a_sentence_stands_in_place_of_a_number(count):
    solution = pressed(balls(count=count), 1e4)
    assert solution.spots.count == count
    found = sampling_of(solution)
    assert np.isnan(found.parts).all() == (count < SPOTS)
    words = (
        f"{count} spot{'s' if count > 1 else ''}, too few to estimate from one map how much another map of"
    )
    assert found.source.how.startswith(words) == (count < SPOTS)
    assert (found.source.kind == "unknown") == (not found.bias_of_size) == (count < SPOTS)


def test_what_has_no_quarters_says_so():
    narrow = sampling_of(pressed(rough((7, 200))))
    assert narrow.source.how == "a map of 7 x 200 cells has no quarters of 4 cells along each axis"
    assert sampling_of(pressed(rough((8, 200)))).source.kind == "order of magnitude"
    surface = rough((48, 48), periodic=True)
    layer = rc.layer(surface.grid, MODULUS, 2e-5, base="rigid-frictionless")
    assert sampling_of(pressed(surface, operator=layer)).source.how == (
        "this body is not known with a free boundary"
    )
    free = rc.Surface(surface.heights, rc.Grid((48, 48), 1e-6))
    layer = rc.layer(free.grid, MODULUS, 2e-5, base="rigid-frictionless")
    assert sampling_of(pressed(free, operator=layer)).source.kind == "order of magnitude"


def test_the_budget_adds_it_to_the_error_and_keeps_the_bias_apart():
    solution = pressed(rough((48, 48)).levelled("plane"))
    budget, found = rc.error_budget(solution), sampling_of(solution)
    assert budget.sources[-1] == found.source
    number = budget["contact_fraction"]
    assert number.parts[-1] == pytest.approx(found.parts[NUMBERS.index("contact_fraction")], rel=1e-12)
    assert number.error == pytest.approx(math.hypot(*number.parts), rel=1e-14)
    assert number.value == solution.contact_fraction  # nothing is subtracted
    record = json.loads(json.dumps(budget.to_record(), allow_nan=False))
    assert record["contact_fraction"]["sampling"] == number.parts[-1]
    assert record["bias_of_size"] == found.bias_of_size
    lines = repr(budget).splitlines()
    printed = [line for line in lines if not line.startswith("Note: ")]
    assert lines == [*printed, *(f"Note: {note}" for note in budget.notes)] != printed
    assert printed[0].endswith("sampling")
    assert printed[-2] == f"sampling: order of magnitude: {found.source.how}"
    assert printed[-1].startswith(
        "size of the map: the numbers of quarters of the map differ from those of the map by: "
    )
    few = rc.error_budget(pressed(rough((48, 48)), 1e4))
    assert math.isnan(few["mean_gap"].error)
    assert repr(few).splitlines()[-1] == f"sampling: {few.sources[-1].how}"
    assert "1 spot, too few to estimate" in few.sampling
    assert few.to_record()["bias_of_size"] == {}


def test_forms_depths_and_patches_have_none():
    flat = rough((48, 48))
    ball = flat + rc.shapes.paraboloid(flat.grid, radius=2e-4)
    form, at_depth = (rc.error_budget(each) for each in (pressed(ball), rc.press(flat, MODULUS, depth=2e-7)))
    patches = rc.error_budget([pressed(rough((48, 48), seed=seed)) for seed in (1, 2)])
    for budget in (form, at_depth, patches):
        assert "sampling" not in [source.name for source in budget.sources]
        assert (budget.sampling, budget.bias_of_size) == ("", {})
    assert any("taken for the body itself" in note for note in form.notes)
    assert any("maps differ by their highest points" in note for note in at_depth.notes)
    assert not any("ampling" in note for note in patches.notes)
    # What the notes advise gives the line.
    assert any("levelled('quadratic')" in note for note in form.notes)
    assert any(note.endswith("Prescribe force or pressure.") for note in at_depth.notes)
    for budget in (rc.error_budget(pressed(each)) for each in (ball.levelled("quadratic"), flat)):
        assert budget.sources[-1].name == "sampling"


def test_a_note_names_it_where_it_is_nearly_all_of_an_error():
    sources = (ErrorSource("grid", "bias", ""), ErrorSource("sampling", "order of magnitude", ""))
    number = QuotedNumber("mean_gap", 1.0, "m", (0.01, 0.3))
    (note,) = notes_on_sources([number], sources)
    assert note == f"Nearly all of the error of mean gap (30 %) comes from sampling. {REMEDIES['sampling']}"
    assert str(ErrorBudget((number,), sources, ())["mean_gap"].relative_error).startswith("0.300")


def test_it_is_of_the_size_of_what_other_maps_give():
    """32 maps: their scatter is known to 1/sqrt(62) = 13 %, the mean square of 32 estimates of 3 freedoms to 14 %.

    Quarters share waves, so that the estimate is rather too small: by a quarter in docs/concepts/errors.md.
    """
    values, estimates = [], []
    names = ("interfacial_stiffness", "contact_area", "mean_gap")
    for seed in range(32):
        solution = pressed(rough((48, 48), seed=seed).levelled("plane"), 2e6)
        found = sampling_of(solution)
        values.append([getattr(solution, name) for name in names])
        estimates.append([relative(found, name, solution) for name in names])
    true = np.std(values, axis=0, ddof=1) / np.mean(values, axis=0)
    ratio = np.sqrt(np.mean(np.square(estimates), axis=0)) / true
    assert ((ratio > 0.5) & (ratio < 2)).all()
