"""A foundation of viscoelastic springs under a body: exact between two states for a depth that changes uniformly.

A spring follows the body while its force is compressive, and creeps freely otherwise. Its state consists of its
displacement and the stresses of its Maxwell elements. One touch or release within a step is located to the last digit.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from roughcontact.errors import InputError
from roughcontact.theory.tools.roots import bisect
from roughcontact.validation import Array, Mask
from roughcontact.viscoelastic.prony_series import Viscoelastic

__all__ = ["Springs", "ViscoelasticFoundation"]


@dataclass(frozen=True, slots=True, eq=False)
class Springs:
    """States of n springs.

    Attributes
    ----------
    place : array, shape (n,)
        Displacement of the surface, into the body [m].
    elements : array, shape (k, n)
        Forces of the Maxwell elements per length [N/m].
    on : bool array, shape (n,)
        Whether the spring is in contact.
    stress : array, shape (n,)
        Force of the spring per length [N/m], 0 without contact.
    """

    place: Array
    elements: Array
    on: Mask
    stress: Array


@dataclass(frozen=True, slots=True, eq=False)
class ViscoelasticFoundation:
    """Springs of one material under a one-dimensional profile.

    Parameters
    ----------
    material : Viscoelastic
    transform : array, shape (n,)
        g at the springs [m], in the middle of cells, from the axis outwards.
    width : float
        Width of a cell [m].
    """

    material: Viscoelastic
    transform: Array
    width: float

    def contact_radius(self, springs: Springs, depth: float) -> float:
        """Return the radius of the contact [m], extrapolated from the gaps of the next two springs outside."""
        touched = np.nonzero(springs.on)[0]
        if not len(touched):
            return 0.0
        last = int(touched[-1])
        centre = self.width * (last + 0.5)
        if last + 2 >= len(springs.on):
            return centre + self.width / 2
        near, far = (springs.place + self.transform - depth)[last + 1 : last + 3]
        return centre + self.width * (1 - min(1.0, near / (far - near)) if far > near else 0.5)

    def force(self, springs: Springs, depth: float) -> float:
        """Return the sum of the springs [N]; in the last cell the stress is extrapolated to the end of the contact."""
        touched = np.nonzero(springs.on)[0]
        if not len(touched):
            return 0.0
        last = int(touched[-1])
        length = self.contact_radius(springs, depth) - self.width * last
        slope = float(springs.stress[last] - springs.stress[last - 1]) if last else 0.0
        mean = float(springs.stress[last]) + slope * (length / self.width - 1) / 2
        return 2 * self.width * float(springs.stress[:last].sum()) + 2 * length * mean

    def untouched(self) -> Springs:
        """Return springs at rest."""
        n, k = len(self.transform), len(self.material.moduli)
        return Springs(np.zeros(n), np.zeros((k, n)), np.zeros(n, dtype=bool), np.zeros(n))

    def rest(self, springs: Springs, duration: float) -> Springs:
        """Return the springs after a time without load [s]."""
        n = len(self.transform)
        place, elements = self._creep(springs.place, springs.elements, np.full(n, duration))
        return Springs(place, elements, np.zeros(n, dtype=bool), np.zeros(n))

    def jump(self, springs: Springs, depth: float) -> Springs:
        """Return the springs after a sudden change of the depth [m]; with a dashpot only away from the springs.

        Raises
        ------
        ValueError
            If the material has a dashpot and the body would press the springs further.
        """
        body, m = depth - self.transform, self.material
        place, elements = springs.place, springs.elements
        if m.dashpot:
            rounding = 1e-12 * float(np.abs(body).max())
            if (body > place + rounding).any():
                raise InputError(
                    "a dashpot admits no jump of the depth: its force would be infinite", "let the depth rise"
                )
            on = springs.on & (body >= place - rounding)
        else:
            pressed = springs.on | (body > place)
            # A spring under tension returns to the displacement of zero stress, and separates.
            free = -self._static(place, elements) / m.instantaneous
            on = pressed & (body - place > free)
            stretch = np.where(on, body - place, np.where(springs.on, free, 0.0))
            place, elements = place + stretch, elements + np.array(m.moduli)[:, None] * stretch
        return Springs(place, elements, on, np.where(on, self._static(place, elements), 0.0))

    def move(self, springs: Springs, depth: tuple[float, float], duration: float) -> Springs:
        """Return the springs after a uniform change between two values of the depth [m] in a time [s]."""
        if duration == 0:
            return self.jump(springs, depth[1])
        start, speed = depth[0] - self.transform, (depth[1] - depth[0]) / duration
        place, elements = springs.place, springs.elements
        # A dashpot separates immediately if the body recedes faster than the spring can follow.
        held = springs.on & (self._static(place, elements) + self.material.dashpot * speed >= 0)
        pushed = self._push(place, elements, speed, np.full(len(start), duration))
        tension = self._static(*pushed) + self.material.dashpot * speed < 0
        stays, leaves, free = held & ~tension, held & tension, ~held
        place, elements = np.where(stays, pushed[0], place), np.where(stays, pushed[1], elements)
        on = stays.copy()
        if leaves.any():
            self._release(leaves, (place, elements), speed, duration)
        if free.any():
            on[free] = self._touch(free, (place, elements), start, speed, duration)
        stress = np.where(on, self._static(place, elements) + self.material.dashpot * speed, 0.0)
        return Springs(place, elements, on, np.maximum(stress, 0.0))

    def _release(self, who: Mask, state: tuple[Array, Array], speed: float, duration: float) -> None:
        """Push the springs until they would be in tension, and let them creep from there on, in place."""
        place, elements = state[0][who], state[1][:, who]
        damping = self.material.dashpot * speed

        def pulls(t: Array) -> Mask:
            return np.asarray(self._static(*self._push(place, elements, speed, t)) + damping < 0)

        t = bisect(pulls, np.zeros(len(place)), np.full(len(place), duration))
        state[0][who], state[1][:, who] = self._creep(*self._push(place, elements, speed, t), duration - t)

    def _touch(
        self, who: Mask, state: tuple[Array, Array], start: Array, speed: float, duration: float
    ) -> Mask:
        """Let the springs creep until the body reaches them, and push them from there on, in place."""
        place, elements = state[0][who], state[1][:, who]
        body = start[who]
        crept = self._creep(place, elements, np.full(len(place), duration))
        met = body + speed * duration > crept[0]
        # A spring that was never touched is met at displacement zero; a creeping spring where the body and the spring
        # meet.
        t = np.clip(-body[met] / speed, 0.0, duration) if speed else np.zeros(int(met.sum()))
        own, rest = place[met], elements[:, met]
        creeps = (own != 0) | rest.any(axis=0)
        if creeps.any():

            def inside(t: Array) -> Mask:
                crept_place, _ = self._creep(own[creeps], rest[:, creeps], t)
                return np.asarray(body[met][creeps] + speed * t > crept_place)

            t[creeps] = bisect(inside, np.zeros(int(creeps.sum())), np.full(int(creeps.sum()), duration))
        _, rest = self._creep(own, rest, t)
        crept[0][met], crept[1][:, met] = self._push(body[met] + speed * t, rest, speed, duration - t)
        state[0][who], state[1][:, who] = crept
        return np.asarray(met)

    def _static(self, place: Array, elements: Array) -> Array:
        """Return the stress of springs and elements, without that of the dashpot."""
        return np.asarray(self.material.equilibrium * place + elements.sum(axis=0))

    def _push(self, place: Array, elements: Array, speed: float, time: Array) -> tuple[Array, Array]:
        """Return place and elements after a time at constant speed."""
        moduli, taus = np.array(self.material.moduli)[:, None], np.array(self.material.times)[:, None]
        part = -np.expm1(-time / taus)
        return place + speed * time, elements * (1 - part) + moduli * taus * speed * part

    def _creep(self, place: Array, elements: Array, time: Array) -> tuple[Array, Array]:
        """Return place and elements after a time without load."""
        modes, rates, project = _free_motion(self.material)
        state = modes @ (np.exp(rates[:, None] * time) * (project @ np.vstack([place, elements])))
        return state[0], state[1:]


@cache
def _free_motion(material: Viscoelastic) -> tuple[Array, Array, Array]:
    """Return modes, rates [1/s] and projection of the state (place, elements) that creeps without load."""
    E, tau = np.array(material.moduli), np.array(material.times)
    stress = np.concatenate([[material.equilibrium], np.ones(len(E))])
    if material.dashpot:
        speed = -stress / material.dashpot
        basis = np.eye(len(stress))
    else:
        speed = np.concatenate([[0.0], 1 / tau]) / material.instantaneous
        # Without a dashpot the stress of a free spring is always zero, which removes one unknown.
        basis = np.linalg.svd(stress[None, :])[2][1:].T
    change = np.vstack([speed, E[:, None] * speed - np.diag(np.concatenate([[0.0], 1 / tau]))[1:]])
    rates, vectors = np.linalg.eig(basis.T @ change @ basis)
    modes = (basis @ vectors).real
    return modes, rates.real, np.linalg.pinv(modes)
