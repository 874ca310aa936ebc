"""The table of cycles under shear: numbers of the law row by row, and computed cycles beside them."""

import math
import re
from types import SimpleNamespace

import numpy as np
import pytest

import roughcontact as rc

BODIES = (rc.Solid(2e9, 0.3), rc.Solid(2e9, 0.3))
PRESSURES = [2e6, 4e6]


@pytest.fixture(scope="module")
def surface():
    grid = rc.Grid((32, 48), 1e-6, periodic=True)
    return rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=3e-5, short_cutoff=6e-6)


@pytest.fixture(scope="module")
def law(surface):
    curve = rc.loading_curve(surface, BODIES, pressures=np.geomspace(1e4, 4e6, 25).tolist())
    return rc.shear_law(curve, BODIES, friction=0.3)


def test_each_row_is_what_the_law_says(law):
    found = rc.shear_dataset(law, PRESSURES, [0.5, 1.0])
    assert found["nominal_pressure"].values.tolist() == [2e6, 2e6, 4e6, 4e6]
    assert found["traction_share"].values.tolist() == [0.5, 1.0, 0.5, 1.0]
    for k, (p, share) in enumerate([(p, share) for p in PRESSURES for share in (0.5, 1.0)]):
        cycle = law.cycle(p, traction=share * 0.3 * p)
        row = {name: float(values[k]) for name, values in found.items() if values.ndim}
        assert row["interfacial_stiffness_per_area"] == law.normal.stiffness_at(p)
        assert row["tangential_stiffness_per_area"] == law.stiffness(p)
        assert row["gross_slip"] == law.gross_slip(p)
        # The same formulas for one number and for an array: rounding of interpolation.
        assert row["displacement_amplitude"] == pytest.approx(cycle.displacement[0], rel=1e-12)
        assert row["cycle_loss"] == cycle.loss
        assert row["damping"] == pytest.approx(cycle.damping, rel=1e-12)
    # At mu p, the displacement is that of gross slip.
    np.testing.assert_allclose(found["displacement_amplitude"][1::2], found["gross_slip"][1::2], rtol=1e-12)
    assert (float(found["friction"]), float(found["modulus_ratio"])) == (0.3, law.ratio)
    assert found["cycle_loss"].attrs == {
        "units": "J m-2",
        "long_name": "energy that friction dissipates in a cycle, over the nominal area",
    }
    assert found.attrs["notes"] == "\n".join(law.notes)
    assert "computed_loss" not in found


def test_where_only_single_cells_slip_there_is_no_loss(law):
    least = law.smallest_share(2e6)
    assert 0.01 < least < 0.4  # of some hundred cells
    found = rc.shear_dataset(law, 2e6, [0.9 * least, 1.1 * least])
    assert np.isnan(found["cycle_loss"]).values.tolist() == [True, False]
    assert np.isnan(found["damping"]).values.tolist() == [True, False]
    assert (found["displacement_amplitude"] > 0).all()
    assert found.attrs["notes"].endswith(
        "1 of 2 cycles have no loss: at their amplitudes, only single cells of the map slip."
    )


def test_computed_cycles_stand_at_their_rows_with_the_differences(law):
    computed = SimpleNamespace(
        pressure=4e6 * (1 + 1e-9),  # a force over an area
        tangential_stiffness_per_area=float(law.stiffness(4e6)) / 0.9,
        loop=SimpleNamespace(
            displacement=[float(law.displacement(0.6e6, 4e6)) / 1.1],
            traction=[0.6e6 * (1 - 1e-9)],
            loss=law.loss(4e6, traction=0.6e6) / 1.2,
        ),
        slip_fraction=0.25,
    )
    found = rc.shear_dataset(law, PRESSURES, [0.5, 1.0], cycles=[computed])
    expected = {
        "computed_stiffness": computed.tangential_stiffness_per_area,
        "computed_displacement": computed.loop.displacement[0],
        "computed_loss": computed.loop.loss,
        "stiffness_difference": -0.1,
        "displacement_difference": 0.1,
        "loss_difference": 0.2,
        "slip_fraction": 0.25,
    }
    for name, value in expected.items():
        nan = math.nan
        np.testing.assert_allclose(found[name], [nan, nan, value, nan], rtol=1e-9, err_msg=name)


def test_a_free_map_has_no_gross_slip(surface):
    free = rc.Surface(surface.heights, rc.Grid((32, 48), 1e-6))
    law = rc.shear_law(rc.loading_curve(free, BODIES, pressures=[1e6, 2e6, 4e6]), BODIES, friction=0.3)
    assert np.isnan(rc.shear_dataset(law, 4e6, [0.5])["gross_slip"]).all()
    with pytest.raises(rc.InputError):
        rc.shear_dataset(law, 4e6, [1.0])


@pytest.mark.parametrize(
    ("pressures", "amplitudes", "words"),
    [
        (5e6, [0.5], "the law of this curve ends at 4e+06 Pa (given: 5e+06)"),
        (4e6, [1.1], "the traction exceeds mu p"),
        (4e6, [0.0], "must be positive"),
        (4e6, ["half"], "must be a number"),
        (0.0, [0.5], "the nominal pressure [Pa] must be positive"),
        (-4e6, [0.5], "the nominal pressure [Pa] must be positive"),
    ],
)
def test_what_is_out_of_range_is_refused(law, pressures, amplitudes, words):
    with pytest.raises(rc.InputError, match=re.escape(words)):
        rc.shear_dataset(law, pressures, amplitudes)
