"""What would make a measured joint that of its topography: a waviness, or flow."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np

from roughcontact.labels.engineering_units import written
from roughcontact.measurement.joint_data import JointData
from roughcontact.measurement.joint_model import UNLIKELY, JointModel
from roughcontact.validation import Array

__all__ = ["JointExplanation", "explanations"]

SHARES = np.geomspace(0.01, 1, 25)  # of the nominal area
SOFTENED = np.geomspace(
    2, 100, 41
)  # hardness over the largest pressure; flow is computed up to half of the joint
HELD = 0.5  # share of the joints of the topography that the emulator must hold


@dataclass(frozen=True, slots=True)
class JointExplanation:
    """A value of one more parameter with which a measurement is that of the joints of a topography.

    Attributes
    ----------
    name : {"carrying", "hardness"}
        Share of the nominal area that the crests of a waviness carry, or the hardness of the softer face.
    unit : str
    low, best, high : float
        Ends of the interval in which the measurement departs no more than 2 % of joints do, and where it departs least.
    """

    name: str
    unit: str
    low: float
    best: float
    high: float

    def __str__(self) -> str:
        """Return it in words."""
        low, best, high = (written(value, self.unit) for value in (self.low, self.best, self.high))
        if self.name == "hardness":
            return f"a hardness of {best} ({low} to {high})"
        share = f"{self.best:.0%} of the area ({self.low:.0%} to {self.high:.0%})"
        return f"a waviness whose crests carry {share}"


def explanations(
    model: JointModel, data: JointData, points: Array, flows: bool
) -> tuple[JointExplanation, ...]:
    """Return what explains a measurement, for joints of the topography of shape (m, 5), and whether they may flow."""
    wavy = [(dataclasses.replace(model, carrying=share), points) for share in SHARES]
    found = [_explanation("carrying", "", SHARES, [_chance(data, *joints) for joints in wavy])]
    if flows:
        values = SOFTENED * float(data.pressures.max())
        soft = [np.column_stack([points, np.full(len(points), math.log(value))]) for value in values]
        found.append(
            _explanation("hardness", "Pa", values, [_chance(data, model, joints) for joints in soft])
        )
    return tuple(each for each in found if each is not None)


def _chance(data: JointData, model: JointModel, points: Array) -> float:
    """Return the probability that one of the joints departs as far from them as the measurement."""
    inside = points[model.inside(points, data.log_pressures)]
    if len(inside) < HELD * len(points):
        return 0.0
    chances = model.chances(data, inside).values()
    return len(chances) * min(chances)


def _explanation(name: str, unit: str, values: Array, chances: list[float]) -> JointExplanation | None:
    """Return the values that fit; None if none does, or if the last one, next to no change, does."""
    fitting = values[np.array(chances) >= UNLIKELY]
    if not fitting.size or fitting[-1] == values[-1]:
        return None
    best = float(values[int(np.argmax(chances))])
    return JointExplanation(name, unit, float(fitting[0]), best, float(fitting[-1]))
