"""A cycle of shear as labelled data."""

import numpy as np
import pytest

import roughcontact as rc

BODIES = (rc.Solid(2e9, 0.0), rc.Solid(2e9, 0.0))
GRID = rc.Grid((16, 20), (1e-6, 1.5e-6), periodic=True)
SURFACE = rc.self_affine(GRID, hurst=0.8, rms=1e-7, rng=1, short_cutoff=4e-6)


@pytest.fixture(scope="module")
def cycle():
    law = rc.shear_law(
        rc.loading_curve(SURFACE, BODIES, pressures=[1e6, 2e6, 3e6, 4e6, 5e6]), BODIES, friction=0.3
    )
    pressed = rc.press(SURFACE, BODIES, pressure=4e6)
    return rc.shear_cycle(pressed, BODIES, friction=0.3, traction=6e5, steps=2, law=law, shear_strength=1e5)


def test_columns(cycle):
    data = cycle.to_dataset()
    assert data["heat"].dims == ("y", "x")
    np.testing.assert_array_equal(data["heat"], cycle.heat)
    np.testing.assert_array_equal(data["x"], GRID.coordinates[1])
    for name, values in {
        "loop_displacement": cycle.loop.displacement,
        "loop_traction": cycle.loop.traction,
        "bodies_displacement": cycle.bodies_displacement,
        "first_displacement": cycle.first_displacement,
        "estimated_traction": cycle.estimate.traction,
        "estimated_displacement": cycle.estimate.displacement,
    }.items():
        np.testing.assert_array_equal(data[name], values)
    for name, value in {
        "nominal_pressure": cycle.pressure,
        "cycle_loss": cycle.loop.loss,
        "damping": cycle.loop.damping,
        "estimated_loss": cycle.estimate.loss,
        "estimated_damping": cycle.estimate.damping,
        "tangential_stiffness_per_area": cycle.tangential_stiffness_per_area,
        "slip_fraction": cycle.slip_fraction,
        "closure": cycle.closure,
    }.items():
        assert float(data[name]) == value, name
    assert len(data["loop_traction"]) == 9
    assert len(data["first_traction"]) == 3
    assert data["status"] == "converged"
    assert {data[name].attrs["units"] for name in ("cycle_loss", "heat", "estimated_loss")} == {"J m-2"}
    assert data.attrs["notes"] == "\n".join(cycle.notes) != ""


def test_without_a_law_nothing_is_estimated():
    pressed = rc.press(SURFACE, BODIES, pressure=4e6)
    cycle = rc.shear_cycle(pressed, BODIES, friction=0.3, traction=6e5, steps=1)
    assert not [name for name in cycle.to_dataset() if "estimate" in name]
    assert cycle.differences == {}
    assert cycle.law is cycle.estimate is None
