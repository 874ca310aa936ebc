"""States at which derivatives end or change: open and missing cells, weak contact, ties, full contact, hardness."""

import numpy as np
import pytest

import roughcontact as rc
from perturbed import CASES, EPS, MODULUS, Case, moved, pair, pressed, single, step_of, uncertainty

AT_FIXED = ("force_at_depth", "depth_at_force", "energy_at_force", "energy_at_depth")


@pytest.mark.parametrize("name", CASES)
def test_identities(name):
    """The rounding is that of sums over all cells."""
    state = pressed(CASES[name]())
    found, measured = rc.sensitivity(state), np.isfinite(state.problem.separation)
    heights, rounding = np.where(measured, state.problem.surface.heights, 0.0), 10 * EPS * measured.size
    assert found.share.sum() == pytest.approx(1, abs=rounding)
    # If all heights are raised, nothing changes since first touch; from a level it is as if the bodies approached.
    assert found.depth_at_force.sum() == pytest.approx(0, abs=rounding)
    level = rc.sensitivity(state, reference="level")
    assert level.depth_at_force.sum() == pytest.approx(-1, abs=rounding)
    # Euler: the force is homogeneous of degree 1 in depth and heights.
    euler = state.stiffness * state.depth + (heights * found.force_at_depth).sum()
    assert euler == pytest.approx(state.force, rel=rounding + 10 * state.residual + 10 * found.residual)


@pytest.mark.parametrize("name", ["periodic, cells missing", "free, cells missing", "unequal rings"])
def test_open_cells_and_missing_cells_have_no_part(name):
    state = pressed(CASES[name]())
    found, measured = rc.sensitivity(state), np.isfinite(state.problem.separation)
    for quantity in AT_FIXED:
        assert not getattr(found, quantity)[~state.contact].any()
    for held in ("force", "depth"):
        gap = getattr(found, f"mean_gap_at_{held}")
        assert not gap[~measured].any()
        assert (gap[measured & ~state.contact] < 0).all()  # a raised cell is nearer, and moves nothing


def test_only_the_highest_cell_moves_first_touch():
    state = pressed(CASES["free"]())
    change = {
        name: getattr(rc.sensitivity(state), name) - getattr(rc.sensitivity(state, reference="level"), name)
        for name in (*AT_FIXED, "mean_gap_at_depth", "mean_gap_at_force")
    }
    highest = state.problem.separation == 0
    assert change["depth_at_force"][highest] == pytest.approx(1, abs=2 * EPS)
    assert change["force_at_depth"][highest] == pytest.approx(-state.stiffness)
    assert change["energy_at_depth"][highest] == pytest.approx(-state.force)
    for name, values in change.items():
        assert not values[~highest].any(), name
    assert not change["energy_at_force"].any()
    assert not change["mean_gap_at_force"].any()


@pytest.mark.parametrize("name", ["free", "periodic, cells missing", "unequal rings", "singly periodic"])
def test_depths_from_a_level(name):
    case, rng = CASES[name](), np.random.default_rng(7)
    state = pressed(case)
    found, level = rc.sensitivity(state, reference="level"), np.nanmax(case.body.heights)
    highest = single(case, np.unravel_index(state.problem.separation.argmin(), state.contact.shape))
    for direction in (highest, rng.normal(size=state.contact.shape)):
        forth, back, step = pair(case, direction, level=level, depth=state.depth)
        allowed = sum(map(uncertainty, (forth, back))) / (2 * step)
        along = found.along(direction)
        assert (forth.force - back.force) / (2 * step) == pytest.approx(
            along["force_at_depth"], abs=state.stiffness * allowed
        )
        energy = (forth.elastic_energy - back.elastic_energy) / (2 * step)
        assert energy == pytest.approx(along["energy_at_depth"], abs=2 * state.force * allowed)
        gap = (forth.mean_gap - back.mean_gap) / (2 * step)
        assert gap == pytest.approx(along["mean_gap_at_depth"], abs=2 * allowed)


def touching_load(name="free"):
    """Return a load in which one more cell touches without pressure: an open cell is raised by its gap."""
    case = CASES[name]()
    state = pressed(case)
    room = np.where(state.contact | ~(state.gap > 0), np.inf, state.gap)
    cell = np.unravel_index(room.argmin(), room.shape)
    body = moved(case.body, single(case, cell) * state.gap[cell])
    case = Case(body, case.options, case.force)
    return case, pressed(case, depth=state.depth), cell


@pytest.mark.parametrize("name", ["free", "periodic", "unequal rings"])
def test_at_a_knife_edge_the_derivative_is_that_of_opening(name):
    """Lowering the cell that touches leaves the force as it is, raising it does not; so does the level."""
    case, state, cell = touching_load(name)
    found = rc.sensitivity(state, reference="level")
    assert state.touching[cell]
    assert np.count_nonzero(state.touching) == 1
    assert found.notes == (
        "1 cell touches without pressure: the derivatives hold for changes that open it. For changes that close "
        "it they differ.",
    )
    step, top = step_of(case.body), np.nanmax(case.body.heights)
    for direction, closing in ((single(case, cell), None), (np.ones(state.contact.shape), "load")):
        lowered, raised = (
            pressed(
                case,
                moved(case.body, sign * step * direction),
                depth=state.depth + np.nanmax(moved(case.body, sign * step * direction).heights) - top,
            )
            for sign in (-1, 1)
        )
        allowed = state.stiffness * 2 * max(map(uncertainty, (lowered, raised, state))) / step
        returned = found.along(direction)["force_at_depth"]
        assert (state.force - lowered.force) / step == pytest.approx(returned, abs=allowed)
        other = (raised.force - state.force) / step
        assert other > returned + 10 * allowed
        if closing:
            assert returned == pytest.approx(state.stiffness)
            assert other == pytest.approx(state.loading_stiffness, abs=allowed)
        else:
            assert returned == 0


def test_no_note_without_a_knife_edge():
    assert rc.sensitivity(pressed(CASES["free"]())).notes == ()


def test_a_load_that_missed_its_tolerance_is_noted():
    surface = CASES["free"]().body
    with pytest.raises(rc.ConvergenceError) as caught:
        rc.press(surface, MODULUS, force=0.02, solver=rc.PolonskyKeer(max_steps=3))
    note, *_ = rc.sensitivity(caught.value.solution).notes
    assert note.startswith("The load missed its tolerance")


def test_in_full_contact_the_depth_follows_the_mean():
    """The limit of all formulas; at given depth there is nothing to differentiate."""
    case = CASES["periodic"]()
    state = pressed(case, force=2.0)
    assert state.contact.all()
    found, cells = rc.sensitivity(state), state.contact.size
    highest = state.problem.separation == 0
    np.testing.assert_allclose(found.depth_at_force, highest - 1 / cells, rtol=0, atol=4 * EPS)
    np.testing.assert_array_equal(found.mean_gap_at_force, 0.0)
    direction = np.random.default_rng(2).normal(size=state.contact.shape)
    along = found.along(direction)
    assert set(along) == {"depth_at_force", "mean_gap_at_force", "energy_at_force"}
    forth, back, step = pair(case, direction, force=2.0)
    allowed = 2 * sum(map(uncertainty, (forth, back))) / (2 * step)
    assert (forth.depth - back.depth) / (2 * step) == pytest.approx(along["depth_at_force"], abs=allowed)
    energy = (forth.elastic_energy - back.elastic_energy) / (2 * step)
    assert energy == pytest.approx(along["energy_at_force"], abs=state.force * allowed)
    for name in ("force_at_depth", "mean_gap_at_depth", "energy_at_depth"):
        with pytest.raises(rc.InputError, match=r"full contact.*infinite.*at a given force"):
            getattr(found, name)
    for refused in (found.to_load, found.to_modulus, lambda: found.pullback(gap=direction)):
        with pytest.raises(rc.InputError, match=r"full contact.*infinite.*at a given force"):
            refused()


def test_ties_of_the_highest_cell():
    disc = rc.shapes.flat_disc(rc.Grid((24, 24), 1 / 24), radius=0.3)
    state = rc.press(disc, MODULUS, force=0.01, tolerance=1e-12)
    found = rc.sensitivity(state)
    cells = np.count_nonzero(np.isfinite(disc.heights))
    with pytest.raises(rc.InputError, match=rf"{cells} cells share the greatest height.*reference='level'"):
        _ = found.depth_at_force
    assert found.mean_gap_at_force.any()  # at a given force it does not depend on first touch
    assert rc.sensitivity(state, reference="level").depth_at_force.sum() == pytest.approx(-1)


def hard_case(hardness):
    case = CASES["free"]()
    return Case(case.body, {"hardness": hardness}, 0.01)


@pytest.mark.parametrize("mapped", [False, True], ids=["number", "map"])
def test_first_loading_under_a_hardness(mapped):
    grid = CASES["free"]().body.grid
    spread = 0.2 * np.random.default_rng(1).random(grid.shape) if mapped else 0.0
    case = hard_case(0.09 * (1 + spread))
    state = pressed(case)
    found, plastic = rc.sensitivity(state), np.count_nonzero(state.plastic)
    assert plastic > 30
    assert np.count_nonzero(state.contact) > plastic + 30
    assert not found.force_at_depth[state.plastic & (state.problem.separation > 0)].any()
    kinds = {"depth": "force", "force": "depth"}
    for direction in (single(case, np.argwhere(state.contact & ~state.plastic)[3]), spread + found.share):
        assert set(found.along(direction)) == {
            *("force_at_depth", "depth_at_force", "mean_gap_at_force", "mean_gap_at_depth"),
        }
        for held, name in kinds.items():
            forth, back, step = pair(case, direction, **{held: getattr(state, held)})
            allowed = sum(map(uncertainty, (forth, back))) / (2 * step)
            scale = state.stiffness if name == "force" else 1.0
            for quantity, size in ((name, scale), ("mean_gap", 2.0)):
                difference = (getattr(forth, quantity) - getattr(back, quantity)) / (2 * step)
                assert difference == pytest.approx(
                    found.along(direction)[f"{quantity}_at_{held}"], abs=size * allowed
                )
    for name in ("energy_at_force", "energy_at_depth"):
        with pytest.raises(rc.InputError, match="under a hardness the elastic energy has no derivative"):
            getattr(found, name)
    # The hardness itself: a step of a millionth.
    step = 0.09e-6
    for held, name in kinds.items():
        forth, back = (
            pressed(hard_case(case.options["hardness"] + sign * step), **{held: getattr(state, held)})
            for sign in (1, -1)
        )
        assert np.array_equal(forth.plastic, back.plastic)
        allowed = (
            sum(map(uncertainty, (forth, back))) / (2 * step) * (state.stiffness if name == "force" else 1)
        )
        difference = (getattr(forth, name) - getattr(back, name)) / (2 * step)
        assert difference == pytest.approx(found.to_hardness()[f"{name}_at_{held}"], abs=allowed)
