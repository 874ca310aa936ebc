"""The case of surfaces that flow, are unloaded and pressed again."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.study.cases import find_case
from roughcontact.study.cases.loop_case import CASE, LoopParameters
from roughcontact.study.study_errors import StudyError
from study.cases.pure import pure_record

GIVEN = {
    "points": 32,
    "size": 2e-3,
    "modulus": 1e11,
    "hurst": 0.7,
    "rms": 1e-6,
    "loads": 4,
    "relative_hardness": 0.2,
}


def run(seed=0, **given):
    return CASE.run(LoopParameters(**(GIVEN | given)), np.random.default_rng(seed))


def test_it_comes_with_the_package():
    assert find_case("loop") is CASE


@pytest.mark.parametrize("flow", ["removed", "raised"])
def test_it_is_the_loop_of_the_library(flow):
    record = run(flow=flow)
    surface = rc.self_affine(rc.Grid((32, 32), 2e-3 / 32), 0.7, 1e-6, np.random.default_rng(0))
    hardness = 0.2 * 1e11 * rc.surface_moments(surface, derivative="spectral").rms_slope
    forces = LoopParameters(**GIVEN).forces * (1e11 * 2e-3 * 1e-6)
    loop = rc.loading_loop(surface, 1e11, hardness=hardness, forces=forces, flow=flow)
    np.testing.assert_array_equal(record["depth"], loop.loading.depth)
    np.testing.assert_array_equal(record["unloaded_stiffness"], loop.unloading.stiffness[::-1])
    np.testing.assert_array_equal(record["flow_volume"], loop.loading.flow.flow_volume)
    assert float(record["dissipated_work"]) == loop.dissipated_work
    assert float(record["residual_depth"]) == loop.residual_depth > 0
    assert (record["residual"] < 1e-8).all()


def test_it_is_pure_and_survives_as_text():
    pure_record(run)


def test_without_a_hardness_it_is_refused():
    with pytest.raises(StudyError, match="a loop with plastic flow needs a hardness"):
        run(relative_hardness=None)
