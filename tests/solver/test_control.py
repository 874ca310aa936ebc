"""How a solve ended goes from process to process."""

import multiprocessing
import pickle
from concurrent.futures import ProcessPoolExecutor
from functools import partial

import numpy as np
import pytest

import roughcontact as rc

STARTS = [start for start in ("fork", "spawn") if start in multiprocessing.get_all_start_methods()]
# Python 3.12 warns of forks beside threads, which this process may have, and JAX if it is loaded: that they go well is
# what is shown here.
FORKS = pytest.mark.filterwarnings(
    "ignore:This process .* is multi-threaded:DeprecationWarning",
    r"ignore:os.fork\(\) was called:RuntimeWarning",
)
PATIENCE = 240  # [s], of a busy machine

BODY = rc.Solid(1.0, 0.3)
SURFACE = rc.self_affine(rc.Grid((12, 14), 1 / 12), 0.8, 0.01, np.random.default_rng(0))
LINE = rc.self_affine(rc.Grid(40, 1 / 40), 0.8, 0.01, np.random.default_rng(0))
HALF = rc.self_affine(rc.Grid((12, 16), 1 / 12, (True, False)), 0.8, 0.01, np.random.default_rng(0))
OPERATORS = {
    **{
        method: rc.half_space(SURFACE.grid, 1.0, method=method)
        for method in ("fft", "dense", "moving-grid", "multilevel")
    },
    "singly periodic": rc.half_space(HALF.grid, 1.0),
    "layer": rc.layer(SURFACE.grid, BODY, 0.5, base="bonded"),
    "line": rc.line(LINE.grid, 1.0),
    "foundation": rc.foundation(LINE.grid, 1.0),
}  # fmt: skip
PRESS = partial(rc.press, SURFACE, 1.0, force=0.05)
WORK = [partial(PRESS, solver=rc.PolonskyKeer(max_steps=2)), PRESS] * 2  # misses its tolerance, and does not


def sent(thing):
    return pickle.loads(pickle.dumps(thing))


def missed():
    with pytest.raises(rc.ConvergenceError) as caught:
        WORK[0]()
    return caught.value


def test_a_missed_tolerance_can_be_sent():
    error = missed()
    other = sent(error)
    assert str(other) == str(error)
    assert "ran out of steps" in str(other)
    assert not other.solution.status.converged
    np.testing.assert_array_equal(other.solution.pressure, error.solution.pressure)


@pytest.mark.parametrize("kind", OPERATORS)
def test_a_solution_can_be_sent_and_asked(kind):
    operator = OPERATORS[kind]
    body = {LINE.grid: LINE, HALF.grid: HALF}.get(operator.grid, SURFACE)
    solution = rc.press(body, 1.0, force=0.05, operator=operator)
    fresh, stiffness = sent(solution), solution.stiffness
    asked = sent(solution)
    for other in (fresh, asked):
        np.testing.assert_array_equal(other.pressure, solution.pressure)
        np.testing.assert_array_equal(other.gap, solution.gap)
        assert other.stiffness == stiffness
        assert other.notes == solution.notes


def test_a_slide_can_be_sent_and_asked():
    solution = rc.slide(rc.press(SURFACE, BODY, force=0.05), BODY, friction=0.3, force=0.004)
    other = sent(solution)
    np.testing.assert_array_equal(other.traction, solution.traction)
    np.testing.assert_array_equal(other.stiffness, solution.stiffness)


def outcome(get):
    """Return whether an answer met its tolerance, and its pressure."""
    try:
        return True, get().pressure
    except rc.ConvergenceError as error:
        return False, error.solution.pressure


def check(answers):
    """Refuse answers that are not those of `WORK`, computed here."""
    expected = [outcome(work) for work in WORK]
    assert [good for good, _ in expected] == [False, True] * (len(WORK) // 2)
    for (good, pressure), (wanted, known) in zip(map(outcome, answers), expected, strict=True):
        assert good == wanted
        np.testing.assert_array_equal(pressure, known)


@FORKS
@pytest.mark.parametrize("start", STARTS)
def test_a_pool_goes_on_after_a_miss(start):
    with multiprocessing.get_context(start).Pool(1) as pool:
        found = [pool.apply_async(work) for work in WORK]
        check([partial(answer.get, PATIENCE) for answer in found])


@FORKS
@pytest.mark.parametrize("start", STARTS)
def test_an_executor_goes_on_after_a_miss(start):
    with ProcessPoolExecutor(1, multiprocessing.get_context(start)) as pool:
        found = [pool.submit(work) for work in WORK]
        check([partial(answer.result, PATIENCE) for answer in found])


@pytest.mark.parametrize("settings", [rc.PolonskyKeer, rc.ActiveSet])
@pytest.mark.parametrize("steps", [0, -3, 2.5, "many"])
def test_a_limit_of_products_is_a_whole_number_of_them(settings, steps):
    with pytest.raises(ValueError, match="max_steps must be"):
        settings(max_steps=steps)
