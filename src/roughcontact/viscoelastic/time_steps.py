"""Steps between the given times of a history: fixed ones, or adapted to errors that step doubling estimates."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from roughcontact.validation import Array
from roughcontact.viscoelastic.contact_in_time import BodyState, ContactInTime, Search, Trial
from roughcontact.viscoelastic.viscoelastic_state import ViscoelasticState

__all__ = ["AdaptiveSteps", "FixedSteps", "History", "Restart"]

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

    `error` is the estimate at its end, of the whole history; `products` includes those of the estimate. The first half
    of a step is not the `last`.
    """

    trial: Trial
    end: BodyState
    error: float
    products: int
    last: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class Restart:
    """A point of a history, and all that the rest depends on, to the last bit.

    `passed` is the index of the last given time that has passed; `error` and `step` are those of adaptive steps.
    """

    passed: int
    body: BodyState
    search: Search
    error: float
    step: float


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
            if time <= memory.time:  # before a restart
                continue
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
        if memory.time == interval.begin:  # not after a restart
            self.step = min(self.step, FIRST * length)
        products = 0
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
            yield Done(first, middle, self.error + own, products // 2, last=False)
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


@dataclass(frozen=True, slots=True, eq=False)
class History:
    """A load that is linear in time between given times, shape (n,); two equal times are a jump."""

    contact: ContactInTime
    times: Array
    loads: Array
    steps: FixedSteps | AdaptiveSteps

    def states(self, start: Restart | None = None) -> Iterator[tuple[ViscoelasticState, Restart | None]]:
        """Yield the states at all steps, or at those after `start`, and where a restart can begin after each."""
        contact, steps = self.contact, self.steps
        # A dashpot needs time to move under a sudden force.
        sudden = not (contact.forced and contact.material.dashpot)
        error = 0.0 if isinstance(steps, AdaptiveSteps) else math.nan
        passed = 0

        def reached(done: Done, *, given: bool) -> tuple[ViscoelasticState, Restart | None]:
            state = contact.state(done.trial, done.end, done.error, done.products, prescribed=given)
            step = steps.step if isinstance(steps, AdaptiveSteps) else math.inf
            restart = Restart(passed, done.end, contact.search, done.error, step) if done.last else None
            return state, restart

        def jump(before: BodyState, load: float) -> Done:
            trial = contact.attempt(before, 0.0, load, before.guess)
            return Done(trial, trial.finished(), error, trial.state.steps + 1)

        times, loads = self.times.tolist(), self.loads.tolist()
        if start is None:
            done = jump(contact.untouched(times[0]), loads[0] if sudden else 0.0)
            memory = done.end
            yield reached(done, given=True)
        else:
            passed, memory, error, contact.search = start.passed, start.body, start.error, start.search
            if isinstance(steps, AdaptiveSteps):
                steps.error, steps.step = start.error, start.step
        for k in range(passed, len(times) - 1):
            interval = Interval(*times[k : k + 2], *loads[k : k + 2])
            if interval.begin < interval.end:
                for done in steps.through(contact, memory, interval, times[-1] - interval.begin):
                    memory, error = done.end, done.error
                    given = memory.time == interval.end
                    passed = k + given
                    yield reached(done, given=given)
            elif interval.first != interval.last and sudden:
                if isinstance(steps, AdaptiveSteps):
                    steps.step = math.inf
                done = jump(memory, interval.last)
                memory, passed = done.end, k + 1
                yield reached(done, given=True)
