"""One step in time of a viscoelastic half-space whose displacement is linear within the step.

With A the product of the elastic operator, the strain-like field X and the elements r_k obey

    u = A X,    p = m X + sum r_k + c X',    r_k' = -r_k/tau_k + m_k X'

in units of a reference modulus. Over a step dt, with x = dt/tau_k, e = exp(-x) and phi = (1 - e)/x,

    r_k <- e r_k + m_k phi (X_new - X),    p = M (X_new - past),    M = m + sum m_k phi + c/dt.

So a step is an elastic contact with the modulus M, whose separation is that of the surface displaced by A past.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple

from roughcontact.solver.inner_product import Measure
from roughcontact.viscoelastic.prony_series import Viscoelastic

__all__ = ["Element", "Pair", "Transition", "combined"]


class Pair(NamedTuple):
    """A field like a pressure [Pa], and the elastic displacement that it causes [m]."""

    pressure: Any
    displacement: Any


def combined(terms: Iterable[tuple[float, Pair]]) -> Pair:
    """Return a sum of pairs with factors; of one term at least."""
    (factor, first), *others = terms
    pressure, displacement = factor * first.pressure, factor * first.displacement
    for factor, pair in others:
        pressure = pressure + factor * pair.pressure
        displacement = displacement + factor * pair.displacement
    return Pair(pressure, displacement)


@dataclass(frozen=True, slots=True)
class Element:
    """A Maxwell element over a step.

    Attributes
    ----------
    modulus : float
        m_k, in units of the reference modulus.
    ratio : float
        x, the step over the relaxation time.
    """

    modulus: float
    ratio: float

    @property
    def kept(self) -> float:
        """The factor e of the element's pressure over the step."""
        return math.exp(-self.ratio)

    @property
    def taken(self) -> float:
        """The mean phi of exp(-s) for s from 0 to x: what the element keeps of a uniform change of the strain."""
        return -math.expm1(-self.ratio) / self.ratio if self.ratio > 0 else 1.0

    @property
    def averaged(self) -> float:
        """The factor (1 - phi)/x of the change of the strain in the mean of the element's pressure."""
        x = self.ratio
        return 0.5 - x / 6 if x < 1e-4 else (1 - self.taken) / x

    @property
    def damped(self) -> float:
        """The dissipation of an element that starts at rest, per m_k times the squared change of the strain."""
        x = self.ratio
        if x < 1e-2:
            return x * (1 / 3 - x * (1 / 4 - x * (7 / 60 - x / 24)))
        return (x + 2 * math.expm1(-x) - math.expm1(-2 * x) / 2) / x**2


@dataclass(frozen=True, slots=True)
class Transition:
    """The numbers of a step; moduli in units of the reference modulus.

    Attributes
    ----------
    elements : tuple of Element
    equilibrium : float
        m.
    viscous : float
        c/dt; 0 for a jump, under which only a body at rest has a dashpot.
    """

    elements: tuple[Element, ...]
    equilibrium: float
    viscous: float

    @classmethod
    def of(cls, material: Viscoelastic, reference: float, step: float) -> Transition:
        """Return the numbers for a material and a step [s], 0 for a jump, with a reference modulus [Pa]."""
        pairs = zip(material.moduli, material.times, strict=True)
        return cls(
            tuple(Element(modulus / reference, step / time) for modulus, time in pairs),
            material.equilibrium / reference,
            material.dashpot / (reference * step) if step else 0.0,
        )

    @property
    def modulus(self) -> float:
        """M, the modulus of the step."""
        return (
            self.equilibrium + self.viscous + math.fsum(each.modulus * each.taken for each in self.elements)
        )

    @property
    def halved(self) -> Transition:
        """The numbers of half the step."""
        elements = tuple(Element(each.modulus, each.ratio / 2) for each in self.elements)
        return Transition(elements, self.equilibrium, 2 * self.viscous)

    def past(self, strain: Pair, elements: tuple[Pair, ...]) -> Pair:
        """Return the strain at the end of a step without pressure."""
        pulls = zip(self.elements, elements, strict=True)
        whole = self.modulus
        return combined(
            [
                ((whole - self.equilibrium) / whole, strain),
                *((-each.kept / whole, pressure) for each, pressure in pulls),
            ]
        )

    def after(self, elements: tuple[Pair, ...], change: Pair) -> tuple[Pair, ...]:
        """Return the elements after a change of the strain."""
        return tuple(
            combined([(each.kept, old), (each.modulus * each.taken, change)])
            for each, old in zip(self.elements, elements, strict=True)
        )

    def mean_pressure(self, strain: Any, elements: Iterable[Any], change: Any) -> Any:
        """Return the pressure averaged over the step, of fields or of their totals."""
        mean = self.equilibrium * strain + (0.5 * self.equilibrium + self.viscous) * change
        for each, old in zip(self.elements, elements, strict=True):
            mean = mean + each.taken * old + each.modulus * each.averaged * change
        return mean

    def pressure(self, strain: Any, elements: Iterable[Any], change: Any) -> Any:
        """Return the pressure at the end of the step."""
        end = self.equilibrium * strain + (self.equilibrium + self.viscous) * change
        for each, old in zip(self.elements, elements, strict=True):
            end = end + each.kept * old + each.modulus * each.taken * change
        return end

    def dissipated(self, elements: tuple[Pair, ...], change: Pair, measure: Measure) -> float:
        """Return the energy that dashpots dissipate in the step [J]."""
        squared = measure.dot(change.pressure, change.displacement)
        total = self.viscous * squared
        for each, old in zip(self.elements, elements, strict=True):
            lost = -math.expm1(-each.ratio)
            if not lost:
                continue
            own = measure.dot(old.pressure, old.displacement) / each.modulus
            mixed = measure.dot(old.pressure, change.displacement)
            total += (
                own * lost * (1 - lost / 2)
                + mixed * lost**2 / each.ratio
                + squared * each.modulus * each.damped
            )
        return total

    def stored(self, strain: Pair, elements: tuple[Pair, ...], measure: Measure) -> float:
        """Return the energy of the springs [J]."""
        own = self.equilibrium * measure.dot(*strain)
        parts = (
            measure.dot(*pair) / each.modulus for each, pair in zip(self.elements, elements, strict=True)
        )
        return 0.5 * (own + math.fsum(parts))
