"""Hardness and waviness of measured joints: as a parameter, and as what explains a measurement."""

import dataclasses
import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.measurement.joint_emulator import FLOWING, SOFTEST, flow_terms, joint_emulator
from roughcontact.measurement.joint_model import JointModel

RMS, ROLLOFF, MODULUS = 1.2e-6, 1e-4, 115e9
SCALE = MODULUS * RMS / ROLLOFF  # E* h/l
AREA = (14 * ROLLOFF) ** 2
P = np.geomspace(0.03, 0.3, 5) * SCALE
GIVEN = {"modulus": MODULUS, "modulus_error": 0.02, "area": AREA, "branch": "loading"}
TOPOGRAPHY = rc.JointTopography(RMS, 0.03, ROLLOFF, 0.1, 0.8, 0.05)
POINT = np.array([math.log(RMS), math.log(ROLLOFF), 0.8, math.log(6), math.log(MODULUS)])
MODEL = JointModel(joint_emulator(), AREA)


def measured(model=MODEL, hardness=None, times=1.0):
    """The mean joint of the topography, its stiffness times a factor."""
    point = POINT if hardness is None else np.append(POINT, math.log(hardness))
    mean, _ = model.stiffness(point[None], np.log(P))
    return rc.JointStiffness(P, times * np.exp(mean[0]), 0.02, 0.01)


def test_the_effect_of_flow_vanishes_for_hard_joints_and_for_large_ones_it_is_softer():
    place = np.log(P / SCALE)
    emulator = joint_emulator()
    effects = [flow_terms(place, np.log(hardness)) @ emulator.flow for hardness in (0.8, 3.0, 1e3)]
    assert (effects[0] < effects[1]).all()
    assert (effects[1][-2:] < 0).all()
    # Every term holds one over the hardness: from 3 to 1 000 each falls by a factor of 333 or more.
    bound = abs(flow_terms(place, np.log(3.0)) * emulator.flow).sum(axis=1) * 3 / 1e3
    assert (abs(effects[2]) <= bound).all()


def test_a_known_hardness_gives_the_height():
    """At 0.8 E* h/l, p up to 3/8 of it: flow softens the joint by 20 % and more."""
    hardness = 0.8 * SCALE
    data = measured(hardness=hardness)
    flowing = rc.infer_joint(data, **GIVEN, profile=TOPOGRAPHY, hardness=hardness, hardness_error=0.1)
    assert flowing.fits
    truth = RMS**flowing.exponent * ROLLOFF ** (1 - flowing.exponent)
    low, high = flowing.interval(0.5)  # measured without scatter
    assert low < truth < high
    assert [each.name for each in flowing.parameters][-1] == "hardness"
    assert flowing.parameters[-1].unit == "Pa"
    assert "flow" in flowing.notes[0]
    assert flowing.to_record()["explanations"] == []


def test_a_hardness_explains_a_joint_that_is_too_soft():
    hardness = 0.8 * SCALE
    found = rc.infer_joint(measured(hardness=hardness), **GIVEN, profile=TOPOGRAPHY)
    assert not found.fits
    names = {each.name: each for each in found.explanations}
    assert names["hardness"].low < hardness < names["hardness"].high
    assert "a hardness of" in " ".join(found.notes)
    assert "elastic" in found.notes[-1]
    assert found.to_record()["explanations"][-1]["unit"] == "Pa"


def test_the_share_that_crests_of_a_waviness_carry_explains_one_too():
    """K is that of a joint of a third of the area at three times the pressure, a third of it per whole area."""
    wavy = dataclasses.replace(MODEL, carrying=1 / 3)
    third = JointModel(joint_emulator(), AREA / 3)
    mean, covariance = wavy.stiffness(POINT[None], np.log(P))
    there, scatter = third.stiffness(POINT[None], np.log(3 * P))
    assert mean == pytest.approx(there - math.log(3), rel=1e-12)
    assert covariance == pytest.approx(scatter, rel=1e-12)
    p = P / 10
    wavy = dataclasses.replace(MODEL, area=AREA / 0.05, carrying=0.05)  # softer by 0.05^(1 - a)
    data = rc.JointStiffness(p, np.exp(wavy.stiffness(POINT[None], np.log(p))[0][0]), 0.02, 0.01)
    found = rc.infer_joint(data, **GIVEN | {"area": AREA / 0.05}, profile=TOPOGRAPHY)
    assert not found.fits
    carrying = found.explanations[0]
    assert carrying.name == "carrying"
    assert carrying.low < 0.05 < carrying.high < 1
    assert "of the area" in str(carrying)


def test_a_joint_that_is_too_stiff_has_no_such_explanation():
    found = rc.infer_joint(measured(times=1.8), **GIVEN, profile=TOPOGRAPHY)
    assert not found.fits
    assert found.explanations == ()
    assert "no waviness or hardness explains it" in " ".join(found.notes)


def test_a_joint_of_its_topography_needs_none():
    found = rc.infer_joint(measured(), **GIVEN, profile=TOPOGRAPHY)
    assert found.fits
    assert found.explanations == ()


def test_a_joint_that_flows_is_explained_by_waviness_alone():
    """Its hardness is known, so that it is no explanation any more."""
    wavy = dataclasses.replace(MODEL, area=AREA / 0.05, carrying=0.05)
    hardness, p = 0.8 * SCALE, np.geomspace(0.003, 0.017, 5) * SCALE  # less than half flows where it carries
    point = np.append(POINT, math.log(hardness))
    data = rc.JointStiffness(p, np.exp(wavy.stiffness(point[None], np.log(p))[0][0]), 0.02, 0.01)
    given = GIVEN | {"area": AREA / 0.05, "hardness": hardness, "hardness_error": 0.05}
    found = rc.infer_joint(data, **given, profile=TOPOGRAPHY)
    assert not found.fits
    assert [each.name for each in found.explanations] == ["carrying"]
    assert found.explanations[0].low < 0.05 < found.explanations[0].high


def test_unloading_is_not_explained_by_flow():
    soft = measured(hardness=0.8 * SCALE)
    found = rc.infer_joint(soft, **GIVEN | {"branch": "unloading"}, profile=TOPOGRAPHY)
    assert not found.fits
    assert "hardness" not in {each.name for each in found.explanations}


def test_pressures_stay_below_half_of_the_hardness_and_the_hardness_above_the_computed_ones():
    points = np.append(POINT, 0.0)[None]
    largest = math.log(P[-1])
    for hardness, inside in (
        (largest - math.log(FLOWING) + 1e-6, True),
        (largest - math.log(FLOWING) - 1e-6, False),
    ):
        points[0, 5] = hardness
        assert MODEL.inside(points, np.log(P))[0] == inside
    small = np.log(P[:1])
    for times, inside in ((1 + 1e-6, True), (1 - 1e-6, False)):
        points[0, 5] = math.log(SOFTEST * SCALE * times)
        assert MODEL.inside(points, small)[0] == inside
