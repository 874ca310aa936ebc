"""The Outlook's ceilings of the pressure."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

import roughcontact as rc
from roughcontact.study.study import Study
from roughcontact_thesis import outlook_hardness
from roughcontact_thesis.figures import drawn, verdicts
from thesis.computed import exported


@pytest.fixture(scope="module")
def found():
    (study,) = outlook_hardness.studies("small")
    parameters = study.parameters | {"points": 64, "loads": 9, "lowest_depth": 0.1, "tolerance": 1e-5}
    return outlook_hardness.averages(
        exported(Study(**(dict(study) | {"samples": 2, "parameters": parameters})), seconds=True)
    )


def test_the_rows_are_ceilings_then_waves_and_one_ceiling_for_all_of_them():
    for scale, points in (("small", 128), ("thesis", 256)):
        (study,) = outlook_hardness.studies(scale)
        last = points // 4
        assert study.rows[0] == {"short_cutoff": 1 / last}
        assert [row["relative_hardness"] for row in study.rows[1:6]] == list(outlook_hardness.CEILINGS)
        grid = rc.Grid((points, points), 1 / points)
        pressures = []
        for row in study.rows[6:]:
            spectrum = rc.SelfAffineSpectrum(outlook_hardness.HURST, short_cutoff=row["short_cutoff"])
            slope = rc.grid_moments(grid, spectrum).rms_slope
            if "relative_hardness" in row:
                pressures.append(row["relative_hardness"] * slope)  # of one spectrum, over E*
        whole = rc.SelfAffineSpectrum(outlook_hardness.HURST, short_cutoff=1 / last)
        given = outlook_hardness.GIVEN * rc.grid_moments(grid, whole).rms_slope
        np.testing.assert_allclose(pressures, given, rtol=1e-12)
        assert len(pressures) == len(study.rows[6:]) / 2


def test_a_ceiling_bounds_the_pressure_and_widens_the_contact(found):
    elastic, hard = found.isel(ceiling=0), found.isel(ceiling=slice(1, None))
    slope = float(found["slope"].isel(waves=-1))
    # Every cell bears at most the ceiling: A >= F/sigma_0, on the average over samples too.
    least = found["force"] * 0.01 / (hard["ceiling"] * slope)
    assert (hard["area"] >= least * (1 - 1e-9)).all()
    assert (elastic["yielded"] == 0).all()
    for name in ("stiffness_change", "region_stiffness_change", "area_change"):
        np.testing.assert_array_equal(elastic[name], 1.0)
    # A force at a lower ceiling takes a larger region, which is stiffer than the part of it that does not yield.
    at = found.sel(force=outlook_hardness.FORCE, method="nearest")
    assert (at["area"].diff("ceiling") >= -1e-12).all()
    # Between a load at which no cell yields and one at which some do, the part is not known.
    yielded = at["yielded"].dropna("ceiling")
    assert yielded.size >= at["ceiling"].size - 1
    assert (yielded.diff("ceiling") >= 0).all()
    assert float(at["area"].isel(ceiling=-1) / at["area"].isel(ceiling=0)) > 2
    assert (hard["region_stiffness"] >= hard["stiffness"] * (1 - 1e-6)).all()
    # The lowest ceiling: next to the whole contact yields, and bears nothing but the ceiling.
    soft = at.isel(ceiling=-1)
    assert float(soft["yielded"]) > 0.7


def test_waves_with_and_without_a_ceiling_end_in_the_same_rows(found):
    last = found.isel(waves=-1)
    for name in ("stiffness", "area"):
        np.testing.assert_array_equal(last[f"waves_{name}"].sel(kind="elastic"), found[name].isel(ceiling=0))
        one = found[name].sel(ceiling=outlook_hardness.GIVEN)
        np.testing.assert_array_equal(last[f"waves_{name}"].sel(kind="ceiling"), one)


def test_it_is_drawn_and_judged(found):
    FigureCanvasAgg(drawn(outlook_hardness, found)).draw()
    assert len(verdicts(outlook_hardness, found)) == 2
