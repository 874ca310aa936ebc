"""A load that rises once and then falls once: growth of the contact in small steps, and t_1 while it recedes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from roughcontact.errors import InputError
from roughcontact.theory.tools.computed import LogCubic
from roughcontact.validation import Array, require
from roughcontact.viscoelastic.prony_series import Creep, Viscoelastic

__all__ = ["ROUNDING", "ElasticLaw", "RiseAndFall"]

ROUNDING = 1e-12  # of the largest value: a change below this is rounding
STEPS = 1000  # of an interval at most 50: the error for a sphere is 1e-8, below that of most curves
GRADED = 1e-4  # the first of the steps that grow in size, relative to an interval
NEAR = 1e-3  # of an interval: no mark closer to its end


@dataclass(frozen=True, slots=True, eq=False)
class ElasticLaw:
    """An elastic curve of unit modulus, Phi = F/E*."""

    phi: Callable[[Array], Array]
    depth: Callable[[Array], Array]
    area: Callable[[Array], Array]

    @classmethod
    def of(cls, rows: Array) -> ElasticLaw:
        """Return the law of the points of a curve, Phi, depth and area in rows."""
        phi, depth, area = rows
        return cls(_reader(depth, phi, "depth"), _reader(phi, depth, "F/E*"), _reader(phi, area, "F/E*"))


@dataclass(frozen=True, slots=True, eq=False)
class _Grown:
    """A quantity while the contact grows, quadratic in each step, and its convolutions with exp(-t/tau).

    A place i + x is the fraction x of step i. Times and values have the middle of each step at odd indices.
    """

    time: Array
    value: Array
    taus: Array
    states: Array

    @classmethod
    def of(cls, time: Array, value: Array, taus: Array) -> _Grown:
        first, middle, last = value[:-1:2], value[1::2], value[2::2]
        slope, bend = 4 * middle - 3 * first - last, 2 * first - 4 * middle + 2 * last
        decay, constant, linear = _weights(np.divide.outer(np.diff(time[::2]), taus))
        added = constant * slope[:, None] + 2 * linear * bend[:, None]
        states = np.zeros((len(first) + 1, len(taus)))
        for i in range(len(first)):
            states[i + 1] = decay[i] * states[i] + added[i]
        return cls(time, value, taus, states)

    def at(self, step: int, x: float) -> tuple[float, Array]:
        """Return value and convolutions at a fraction of a step."""
        first, middle, last = self.value[2 * step : 2 * step + 3]
        slope, bend = x * (4 * middle - 3 * first - last), x**2 * (2 * first - 4 * middle + 2 * last)
        decay, constant, linear = _weights(x * (self.time[2 * step + 2] - self.time[2 * step]) / self.taus)
        return first + slope + bend, decay * self.states[step] + constant * slope + 2 * linear * bend

    def then(self, place: float, now: float) -> tuple[float, Array]:
        """Return the value at a place, and the convolutions that are left of it at a later time."""
        step = min(int(place), len(self.states) - 2)
        value, state = self.at(step, place - step)
        return value, np.exp(-(now - self.time_at(place)) / self.taus) * state

    def rate(self, node: int) -> float:
        """Return the rate at a node: the mean of both sides, at the end of the growth that before."""
        rates = []
        for step, weights in ((node - 1, (1.0, -4.0, 3.0)), (node, (-3.0, 4.0, -1.0))):
            part = slice(2 * step, 2 * step + 3)
            if step + 1 < len(self.states) and (h := np.ptp(self.time[part])):
                rates.append(np.dot(weights, self.value[part]) / h)
        return float(np.mean(rates))

    def time_at(self, place: float) -> float:
        """Return the time of a place."""
        step = min(int(place), len(self.states) - 2)
        begin, end = self.time[2 * step], self.time[2 * step + 2]
        return float(begin + (place - step) * (end - begin))


@dataclass(frozen=True, slots=True, eq=False)
class RiseAndFall:
    """A history in small steps. The growth of the given quantity and t_1 do not depend on the elastic curve."""

    material: Viscoelastic
    by_force: bool
    time: Array
    load: Array
    given: list[int]  # indices of the user's times
    grown: _Grown  # depth, or Phi under given forces
    places: Array  # where the growing contact had the size of the receding one, at the times after the growth

    @classmethod
    def of(cls, material: Viscoelastic, t: Array, load: Array, name: str, marks: Array) -> RiseAndFall:
        """Return the growth under given "forces" or "depths", and t_1; `marks` are the depths of the curve."""
        by_force = name == "forces"
        _one_rise_and_fall(t, load, name)
        # Below the first point of the curve too, the steps are small relative to the depth.
        marks = np.concatenate([marks[0] * 2.0 ** np.arange(-10, 0), marks])
        time, small, given = _in_small_steps(t, load, marks[:0] if by_force else marks)
        value = _creeping(material.creep(), time, small) if by_force else small
        falls = np.flatnonzero(np.diff(value[::2]) < -ROUNDING * value.max())
        most = 2 * int(falls[0]) + 1 if len(falls) else len(value)
        jumps = np.flatnonzero((np.diff(time) == 0) & (np.diff(small) != 0))
        if material.dashpot and len(jumps) and not (by_force and jumps[-1] < most - 1):
            raise InputError(
                "a dashpot admits no jump of the depth: its force would be infinite",
                "let the depth change within a time",
                "times",
            )
        grown = _Grown.of(time[:most], value[:most], np.array(material.times))
        places = _receding(material, grown, time[most - 1 :], small[most - 1 :], by_force)
        return cls(material, by_force, time, small, given, grown, places)

    def on(self, law: ElasticLaw) -> Array:
        """Return force, depth, area, Phi and t_1 in rows, at the user's times."""
        most = len(self.grown.time)
        other = (law.depth if self.by_force else law.phi)(self.grown.value)
        found = _Grown.of(self.grown.time, other, self.grown.taus)
        phis, depths = (self.grown, found) if self.by_force else (found, self.grown)
        after = self._depths_after(depths) if self.by_force else self.load[most:]
        rows = []
        for index in self.given:
            now = float(self.time[index])
            place = index / 2 if index < most else float(self.places[index - most])
            phi, elements = phis.then(place, now)
            force = self.load[index] if self.by_force else self.material.equilibrium * phi
            if not self.by_force:
                force += np.dot(self.material.moduli, elements)
            if self.material.dashpot and not self.by_force and 0 < index < most:
                force += self.material.dashpot * max(0.0, phis.rate(index // 2))
            depth = depths.value[index] if index < most else after[index - most]
            rows.append((force, depth, float(law.area(np.array(phi))), phi, phis.time_at(place)))
        return np.array(rows).T

    def _depths_after(self, depths: _Grown) -> Array:
        """Return the depth after the growth, linear in each small step, from the contact that is still there."""
        m, most = self.material, len(depths.time)
        state, depth, found = depths.states[-1], float(depths.value[-1]), []
        for j, place in enumerate(self.places.tolist(), start=most):
            h = self.time[j] - self.time[j - 1]
            decay, constant, _ = _weights(h / depths.taus)
            begun, left = depths.then(place, self.time[j])
            damping = m.dashpot / h if m.dashpot else 0.0
            # int_{t_1}^t E dd = 0, linear in the depth at the end of the step.
            known = np.dot(m.moduli, decay * state - constant * depth - left)
            stiffness = m.equilibrium + np.dot(m.moduli, constant) + damping
            new = float((m.equilibrium * begun - known + damping * depth) / stiffness)
            state, depth = decay * state + constant * (new - depth), new
            found.append(new)
        return np.array(found)


def _receding(material: Viscoelastic, grown: _Grown, time: Array, load: Array, by_force: bool) -> Array:
    """Return the place of the growth with the contact of each time after it, the first time being its end."""
    moduli, last = np.array(material.moduli), len(grown.states) - 1
    state, size, places = grown.states[-1], float(grown.value[-1]), []

    def excess(place: float, now: float, level: float, begun: Array) -> float:
        """Return what decides whether the contact at a place is too large: positive if it is.

        Under given forces its force less the given one; under given depths the relaxed change of the depth since then,
        with the opposite sign.
        """
        value, left = grown.then(place, now)
        if by_force:
            return float(material.equilibrium * value + moduli @ left - level)
        return float(material.equilibrium * value - moduli @ (begun - left) - level)

    for j in range(1, len(time)):
        now, level, change = float(time[j]), float(load[j]), load[j] - load[j - 1]
        if not by_force:
            h = time[j] - time[j - 1]
            decay, constant, _ = _weights(h / grown.taus)
            state = decay * state + constant * change
            level = material.equilibrium * level + (
                material.dashpot * change / h if material.dashpot else 0.0
            )
        given = now, level, state
        place = 0.0
        if excess(0.0, *given) < 0:
            ends = excess(last, *given) > 0
            place = float(brentq(excess, 0.0, last, given, xtol=1e-13 * last)) if ends else float(last)
        there = grown.then(place, now)[0]
        if there > size * (1 + 1e-9) + ROUNDING * grown.value[-1]:
            raise InputError(
                f"the contact grows again at t = {now:g} s, after it has receded: an elastic curve does not determine "
                "this part of the history",
                "end the history before, or compute it in steps",
                "times",
            )
        size = there
        places.append(place)
    return np.array(places)


def _weights(x: Array) -> tuple[Array, Array, Array]:
    """Return exp(-x), and the integrals of exp(-x (1 - s)) and of s exp(-x (1 - s)) for s from 0 to 1."""
    safe = np.where(x > 0, x, 1.0)
    constant = np.where(x > 0, -np.expm1(-x) / safe, 1.0)
    linear = np.where(x > 1e-3, (1 - constant) / safe, 0.5 - x / 6 + x**2 / 24 - x**3 / 120)
    return np.exp(-x), constant, linear


def _one_rise_and_fall(t: Array, load: Array, name: str) -> None:
    """Refuse a history without a load, and one that rises again after a fall."""
    require(load.max() > 0, "a history needs a positive load", place=name)
    changes = np.diff(load)
    falls = np.flatnonzero(changes < -ROUNDING * load.max())
    rises = np.flatnonzero(changes > ROUNDING * load.max())
    if len(falls) and len(rises) and rises[-1] > falls[0]:
        again = rises[rises > falls[0]][0]
        raise InputError(
            f"the load rises from t = {t[again]:g} s on, after it has fallen: an elastic curve determines a history "
            "with one rise and then one fall",
            "end the history before, or compute it in steps",
            name,
        )


def _in_small_steps(t: Array, load: Array, marks: Array) -> tuple[Array, Array, list[int]]:
    """Return times and loads of small steps with their middles at odd indices, and the indices of the given times.

    The steps of an interval grow from its beginning, and end where the load passes a mark.
    """
    count = int(np.clip(STEPS // len(t), 4, 50))
    graded = np.union1d(np.linspace(0, 1, count + 1), np.geomspace(GRADED, 1, count + 1))
    times, loads = [t[:1]], [np.zeros(1)]
    places = []
    for start, end, before, after in zip(
        np.append(t[0], t[:-1]), t, np.append(0.0, load[:-1]), load, strict=True
    ):
        if end > start or after != before:
            at = (marks - before) / (after - before) if after > before else marks[:0]
            ends = np.union1d(graded, at[(at > 0) & (at < 1 - NEAR)])
            ends = ends[np.append(True, np.diff(ends) > GRADED / 2)]  # rates lose digits in shorter steps
            x = np.empty(2 * len(ends) - 2)
            x[1::2], x[::2] = ends[1:], (ends[1:] + ends[:-1]) / 2
            times.append(start + x * (end - start))
            loads.append(before + x * (after - before))
            times[-1][-1], loads[-1][-1] = end, after
        places.append(sum(map(len, times)) - 1)
    return np.concatenate(times), np.concatenate(loads), places


def _creeping(creep: Creep, t: Array, force: Array) -> Array:
    """Return the convolution of the creep function with a force that is linear between the times [m^2]."""
    thetas, compliances = np.array(creep.times), np.array(creep.compliances)
    steps, before = np.diff(t, prepend=t[0]), np.append(0.0, force[:-1])
    decay, constant, _ = _weights(np.divide.outer(steps, thetas))
    # theta e' + e = J F(t) with F linear over the step
    added = compliances * ((1 - decay) * before[:, None] + (1 - constant) * (force - before)[:, None])
    retarded = np.zeros((len(t) + 1, len(thetas)))
    for i in range(len(t)):
        retarded[i + 1] = decay[i] * retarded[i] + added[i]
    flowed = creep.fluidity * np.cumsum(steps * (before + force) / 2)
    return np.asarray(creep.instantaneous * force + flowed + retarded[1:].sum(axis=1))


def _reader(at: Array, of: Array, what: str) -> Callable[[Array], Array]:
    """Return a column of a curve as a function of another: a power law below the first point, 0 at 0."""
    cubic = LogCubic.of(at, of)
    slope = np.log(of[1] / of[0]) / np.log(at[1] / at[0])

    def read(value: Array) -> Array:
        found = cubic(np.maximum(value, at[0])) * np.minimum(value / at[0], 1.0) ** slope
        if np.isnan(found).any():
            raise InputError(
                f"the elastic curve ends at {what} = {at[-1]:g}, and the history needs {np.max(value):g}",
                "compute the curve for more loads",
                "curve",
            )
        return np.where(value > 0, found, 0.0)

    return read
