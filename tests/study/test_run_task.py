import numpy as np
import pytest
import threadpoolctl
import xarray

from roughcontact.study.case import Case, Parameters
from roughcontact.study.run_task import run_task
from roughcontact.study.study import Study
from roughcontact.study.task import Task, generator
from study.trial import CASE, NAME, WITH_FIELDS


def task(case=CASE, **parameters):
    return Task("key", case, case.parameters(**({"hurst": 0.8} | parameters)), 1, 2)


def of(function):
    return Task("key", Case("of", 1, Parameters, function), Parameters(), 0, 0)


def test_a_task_gives_what_its_case_returns():
    result = run_task(task(seconds=0.01))
    assert (result.key, result.message) == ("key", "")
    assert result.seconds >= 0.01
    expected = CASE.run(CASE.parameters(hurst=0.8), generator(1, 2))
    xarray.testing.assert_identical(result.record, expected)


@pytest.mark.parametrize(
    ("case", "end", "message"),
    [
        (CASE, "error", "ArithmeticError: no contact at 0.8 (trial.py, line "),
        (CASE, "exit", "SystemExit: 3 (trial.py, line "),
        (CASE, "dictionary", "TypeError: a case returns an xarray.Dataset, not dict"),
        (CASE, "object", "TypeError: 'force' has the type object"),
        (WITH_FIELDS, "no field", "InputError: the record lacks 'pressure'"),
    ],
)
def test_whatever_happens_is_an_result(case, end, message):
    result = run_task(task(case, end=end))
    assert result.record is None
    assert result.message.startswith(message)


def test_running_out_of_memory_is_an_result():
    assert run_task(of(lambda parameters, rng: np.empty(2**50))).message.startswith(
        "MemoryError: Unable to allocate"
    )


def test_a_long_message_is_cut():
    def failing(parameters, rng):
        raise ValueError("x" * 10_000)

    assert len(run_task(of(failing)).message) < 1100


def test_an_error_without_words_has_a_name():
    def failing(parameters, rng):
        raise AssertionError

    assert run_task(of(failing)).message.startswith("AssertionError (test_run_task.py, line ")


@pytest.mark.parametrize("end", [KeyboardInterrupt(), SystemExit(143)])
def test_whoever_stops_the_program_stops_it(end):
    def stopped(parameters, rng):
        raise end

    with pytest.raises(type(end)):
        run_task(of(stopped))


def test_a_case_has_one_thread():
    def run(parameters, rng):
        found = threadpoolctl.threadpool_info()
        return xarray.Dataset({"threads": ("pool", [pool["num_threads"] for pool in found])})

    record = run_task(of(run)).record
    assert record["threads"].size > 0
    assert set(record["threads"].values.tolist()) == {1}


def test_samples_are_paired_across_parameters_and_independent_of_each_other():
    study = Study(name="a", case=NAME, seed=4, samples=2, table={"hurst": [0.1, 0.9]})
    force = [run_task(each).record["force"].values for each in study.tasks()]
    np.testing.assert_array_equal(force[0], force[1])
    np.testing.assert_array_equal(force[2], force[3])
    assert (force[0] != force[2]).all()
