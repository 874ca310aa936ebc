"""Steps between the given times of a history: fixed ones, or adapted to errors that step doubling estimates."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

from roughcontact.validation import Array
from roughcontact.viscoelastic.contact_in_time import BodyState, ContactInTime, Trial
from roughcontact.viscoelastic.viscoelastic_state import ViscoelasticState

__all__ = ["AdaptiveSteps", "FixedSteps", "states_along"]

FIRST = 0.1  # of an interval: the first step that is tried
SMALLEST = 2.0**-30  # of an interval: a step that is not divided
GROWTH = (0.1, 4.0)  # smallest and largest change of a step
CAUTION = 0.9


@dataclass(frozen=True, slots=True)
class Interval:
    """A load that is linear in time, between two different times."""

    begin: float
    end: float
    first: float
    last: float

    def at(self, time: float) -> float:
        """Return the load at a time."""
        share = (time - self.begin) / (self.end - self.begin)
        return self.first + (self.last - self.first) * share if share < 1 else self.last


@dataclass(frozen=True, slots=True)
class Done:
    """A step that is accepted.

    `error` is the estimate at its end, of the whole history; `products` includes those of the estimate.
    """

    trial: Trial
    end: BodyState
    error: float
    products: int


@dataclass(frozen=True, slots=True)
class FixedSteps:
    """A number of equal steps in each interval, without an estimate of the error."""

    count: int

    def through(
        self, contact: ContactInTime, memory: BodyState, interval: Interval, left: float
    ) -> Iterator[Done]:
        """Yield the steps of an interval."""
        length = (interval.end - interval.begin) / self.count
        for k in range(1, self.count + 1):
            time = interval.begin + k * length if k < self.count else interval.end
            trial = contact.attempt(memory, time - memory.time, interval.at(time), memory.guess)
            memory = replace(trial.finished(), time=time)
            yield Done(trial, memory, math.nan, trial.state.steps + 1)


@dataclass(slots=True)
class AdaptiveSteps:
    """Steps whose estimated errors of force or depth, strain and energy add up to a tolerance at most.

    Each may use up an equal part of what is left of the tolerance, by the number of steps that are left. The error of
    the fields, which fades, is below the tolerance at each step.
    """

    tolerance: float
    error: float = 0.0
    step: float = math.inf

    def through(
        self, contact: ContactInTime, memory: BodyState, interval: Interval, left: float
    ) -> Iterator[Done]:
        """Yield the steps of an interval; `left` is the time from its begin to the end of the history [s]."""
        length = interval.end - interval.begin
        if math.isinf(self.step):  # at the start and after a jump
            self.step = min(contact.material.times, default=math.inf)
        self.step, products = min(self.step, FIRST * length), 0
        while memory.time < interval.end:
            rest = interval.end - memory.time
            step = rest if self.step > 0.9 * rest else min(self.step, 0.5 * rest)
            time, half_time = memory.time + step, memory.time + step / 2
            whole = contact.attempt(memory, step, interval.at(time), memory.guess)
            between = 0.5 * (memory.pressure + whole.pressure), 0.5 * (memory.depth + whole.depth)
            first = contact.attempt(memory, step / 2, interval.at(half_time), between)
            middle = first.finished()
            second = contact.attempt(middle, step / 2, interval.at(time), whole.guess)
            end = second.finished()
            products += whole.state.steps + first.state.steps + second.state.steps + 2
            own, of_fields = contact.errors(whole, second, end)
            allowed = max(self.tolerance - self.error, 1e-6 * self.tolerance) / _steps_left(
                step, time - interval.begin, left
            )
            excess = max((own / allowed) ** (1 / (contact.order + 1)), (of_fields / self.tolerance) ** 0.5)
            factor = min(max(CAUTION / excess, GROWTH[0]), GROWTH[1]) if excess else GROWTH[1]
            self.step = step * factor
            if excess > 1 and step > SMALLEST * length:
                continue
            yield Done(first, middle, self.error + own, products // 2)
            self.error += own
            memory = replace(end, time=interval.end if step == rest else time)
            yield Done(second, memory, self.error, products - products // 2)
            products = 0


def _steps_left(step: float, elapsed: float, whole: float) -> float:
    """Return the number of steps to the end, this one included, if they stay equal or grow with the elapsed time.

    `elapsed` is the time from the last node to the end of the step, `whole` that to the end of the history [s].
    """
    equal = (whole - elapsed) / step + 1
    growing = math.log(max(whole / elapsed, 1.0)) / math.log1p(step / max(elapsed - step, step)) + 1
    return min(equal, growing)


def states_along(
    contact: ContactInTime, times: Array, loads: Array, steps: FixedSteps | AdaptiveSteps
) -> Iterator[ViscoelasticState]:
    """Yield the states at all steps of a history; two equal times are a jump."""
    # A dashpot needs time to move under a sudden force.
    sudden = not (contact.forced and contact.material.dashpot)
    error = 0.0 if isinstance(steps, AdaptiveSteps) else math.nan
    trial = contact.attempt(contact.untouched(float(times[0])), 0.0, float(loads[0]) if sudden else 0.0, None)
    memory = trial.finished()
    yield contact.state(trial, memory, error, trial.state.steps + 1, prescribed=True)
    nodes = zip(times.tolist(), loads.tolist(), strict=True)
    for (begin, first), (end, last) in pairwise(nodes):
        if begin < end:
            for done in steps.through(contact, memory, Interval(begin, end, first, last), times[-1] - begin):
                memory, error = done.end, done.error
                given = memory.time == end
                yield contact.state(done.trial, memory, error, done.products, prescribed=given)
        elif first != last and sudden:
            if isinstance(steps, AdaptiveSteps):
                steps.step = math.inf
            trial = contact.attempt(memory, 0.0, last, memory.guess)
            memory = trial.finished()
            yield contact.state(trial, memory, error, trial.state.steps + 1, prescribed=True)
