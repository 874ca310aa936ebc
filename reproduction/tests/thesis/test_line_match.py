"""Figures 29 and 30: lines matched to surfaces, of curves that are known."""

import numpy as np
import pytest
import xarray
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact.solver.control import Status
from roughcontact_thesis import fig29_spectrum_factor as fig29, fig30_crossover as fig30
from roughcontact_thesis.calibration import calibrated_lambda
from roughcontact_thesis.figures import drawn, verdicts
from roughcontact_thesis.line_match import Ensemble, match

HURST = [0.4, 1.0, 2.2]
LINE = np.geomspace(1e-7, 10, 97)
SURFACE = np.geomspace(1e-4, 0.07, 30)
ZETA = {"line": 0.95, "surface": 0.8}


def law(force, zeta, hurst):
    return zeta * force ** (1 / (1 + min(hurst, 2)))


def scattered(curves, sizes, rng):
    """Return samples whose mean is the curve exactly: each is the curve times a number."""
    part = 1 + 0.2 * rng.standard_normal(sizes)
    return curves * (part / part.mean())[..., None]


@pytest.fixture(scope="module")
def lines():
    rng = np.random.default_rng(1)
    table = [[scattered(law(LINE, ZETA["line"], h), (4, 25), rng) for h in HURST]] * 2
    return xarray.Dataset(
        {
            "dimensionless_force": ("load", LINE),
            "dimensionless_stiffness": (("points", "hurst", "sample", "line", "load"), table),
        },
        {"points": [512, 8192], "hurst": HURST},
    )


@pytest.fixture(scope="module")
def surfaces():
    rng = np.random.default_rng(2)
    table = [scattered(law(SURFACE, ZETA["surface"], h), 30, rng) for h in HURST]
    modulus, size = 2e9, 1e-3
    # One load of one sample missed its tolerance, and the others have the mean of the law without it.
    status = np.full((3, 30, 30), Status.CONVERGED.value)
    status[0, 3, 5], table[0][3, 5] = Status.STAGNATED.value, 1e3
    others = np.delete(table[0][:, 5], 3)
    table[0][4, 5] += 29 * (law(SURFACE, ZETA["surface"], HURST[0])[5] - others.mean())
    return xarray.Dataset(
        {
            "dimensionless_force": ("load", SURFACE),
            "dimensionless_stiffness": (("hurst", "sample", "load"), table),
            "status": (("hurst", "sample", "load"), status),
            "cell_stiffness": 0.0017 * modulus * size,
        },
        {"hurst": HURST, "points": 513, "modulus": modulus, "size": size},
    )


def test_of_power_laws_figure_29_is_their_closed_form(lines, surfaces):
    found = fig29.averages(lines, surfaces)
    for hurst in HURST:
        one = found.sel(hurst=hurst)
        expected = calibrated_lambda(
            hurst, line_prefactor=ZETA["line"], surface_prefactor=ZETA["surface"], modes=256
        )
        assert float(one["factor"]) == pytest.approx(expected, rel=1e-9)
        assert float(one["mismatch"]) < 1e-9
        # Each sample is the curve times a number: the mean of n of them is known to 0.2/sqrt(n), a force to that over
        # alpha, and lambda to twice as much. Replicates tell the scatter to 1/sqrt(400), samples theirs to 1/sqrt(60).
        stiffness = 0.2 * np.sqrt(1 / 100 + 1 / 30)
        error = 2 * (1 + min(hurst, 2)) * stiffness * expected
        assert float(one["factor_error"]) == pytest.approx(error, rel=0.5)
    assert float(found["window_low"].min()) == pytest.approx(20 * 0.0017)
    assert verdicts(fig29, found)[-1].word == "holds"
    FigureCanvasAgg(drawn(fig29, found)).draw()


def test_a_surface_of_another_shape_is_told(lines, surfaces):
    bent = surfaces.copy()
    bent["dimensionless_stiffness"] = surfaces["dimensionless_stiffness"] * (
        1 + 0.6 * np.sin(3 * np.log(surfaces["dimensionless_force"]))
    )
    found = fig29.averages(lines, bent)
    # Half of the swing either way, of which no factor of the force takes much.
    assert float(found["mismatch"].min()) > 0.3
    assert verdicts(fig29, found)[-1].word == "does not hold"


def test_figure_30_moves_lines_to_surfaces_and_shows_what_is_left(lines):
    forces = np.geomspace(1e-4, 300, 27)
    rng = np.random.default_rng(3)
    # Surfaces that take 1.5 times the force of the lines, and half of that beyond the power law.
    moved = [law(forces / np.where(forces < 0.2, 1.5, 0.75), ZETA["line"], h) for h in HURST]
    table = [scattered(np.minimum(curve, 1.15), 5, rng) for curve in moved]
    dims = ("hurst", "sample", "load")
    surfaces = xarray.Dataset(
        {
            "dimensionless_force": ("load", forces),
            "dimensionless_stiffness": (dims, table),
            "stiffness": (dims, table),
            "status": (dims, np.full((3, 5, 27), Status.CONVERGED.value)),
            "cell_stiffness": 0.0009,
            "full_contact_stiffness": 1.15,
        },
        {"hurst": HURST, "points": 1025, "modulus": 1.0, "size": 1.0},
    )
    found = fig30.averages(lines.isel(points=-1), surfaces)
    np.testing.assert_allclose(found["ratio"], 1.5, rtol=1e-9)
    low = forces < 0.2
    inside = low & (forces > 1e-3)
    np.testing.assert_allclose(found["line"][:, inside], found["surface"][:, inside], rtol=1e-9)
    apart = found.isel(load=int(np.flatnonzero(~low)[0]))
    alpha = [1 / (1 + min(h, 2)) for h in HURST]
    np.testing.assert_allclose(apart["line"] / apart["surface"], 0.5 ** np.array(alpha), rtol=1e-9)
    # Five surfaces do not tell whether by an amount that depends on H.
    assert verdicts(fig30, found)[0].word == "holds in part (they deviate)"
    FigureCanvasAgg(drawn(fig30, found)).draw()


def test_ensembles_that_share_no_window_are_refused():
    curve = law(LINE, 0.8, 0.5)[None]
    with pytest.raises(ValueError, match="a lower and a higher stiffness"):
        match(Ensemble(LINE, curve, 1e-4), Ensemble(LINE, curve, 0.05), 0.05)
