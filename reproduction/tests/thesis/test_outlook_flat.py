"""The Outlook's nominally flat surfaces."""

import numpy as np
import pytest
import xarray
from matplotlib.backends.backend_agg import FigureCanvasAgg

import roughcontact as rc
from roughcontact.study.study import Study
from roughcontact.theory.asperity_models import greenwood_williamson
from roughcontact.theory.persson_theory import persson, persson_separation
from roughcontact.theory.random_surfaces.waves import Waves
from roughcontact_thesis import outlook_flat
from roughcontact_thesis.cell_law import cells_stiffness
from roughcontact_thesis.figures import drawn, findings, verdicts
from thesis.computed import exported

RMS = 0.01


@pytest.fixture(scope="module")
def export():
    (study,) = outlook_flat.studies("small")
    parameters = study.parameters | {"points": 64, "short_cutoff": 1 / 32, "loads": 7, "lowest_force": 0.01}
    rows = [row for row in study.rows if min(row.values()) >= 1 / 8]
    given = {"samples": 2, "parameters": parameters, "rows": rows}
    return exported(Study(**(dict(study) | given)), seconds=True)


@pytest.fixture(scope="module")
def found(export):
    return outlook_flat.averages(export)


def test_rows_are_cut_off_then_rolled_off(found):
    assert list(found["long"].values) == [1, 2, 4, 8, 4, 8]
    assert list(found["kind"].values) == ["cut-off"] * 4 + ["roll-off"] * 2


def test_theories_are_those_of_the_spectrum_of_all_samples(export, found):
    grid = rc.Grid((64, 64), 1 / 64, periodic=True)
    force = export["dimensionless_force"].to_numpy() * RMS
    for row, limit in ((2, {"long_cutoff": 1 / 4}), (5, {"rolloff": 1 / 8})):
        other = rc.self_affine(
            grid, outlook_flat.HURST, RMS, np.random.default_rng(99), short_cutoff=1 / 32, **limit
        )
        waves = Waves.of_heights(other.heights, grid.spacing)
        one = found.isel(row=row)
        np.testing.assert_allclose(one["persson"], persson_separation.stiffness(force, 1.0, waves), rtol=1e-9)
        np.testing.assert_allclose(
            one["persson_area"], persson.contact_fraction(force, 1.0, waves), rtol=1e-9
        )
        law = greenwood_williamson.law(rc.surface_moments(other), 1.0, 1.0)
        np.testing.assert_allclose(one["gw"], law.predict("interfacial_stiffness", force), rtol=1e-3)


def test_cells_stand_where_their_tops_are(export, found):
    for row, length in ((2, 1 / 4), (3, 1 / 8)):
        each = []
        for sample in range(2):
            below = export["below"].isel(row=row, periodic=0, sample=sample).dropna("cell").to_numpy() / RMS
            assert below.size == round(1 / length) ** 2
            each.append(
                cells_stiffness(below, length, export["dimensionless_force"].to_numpy(), outlook_flat.HURST)
            )
        np.testing.assert_allclose(found["cells"].isel(row=row), np.mean(each, axis=0), rtol=1e-9)


def test_a_free_body_sinks_in_and_a_periodic_one_does_not(export, found):
    periodic, free = found.sel(periodic=True), found.sel(periodic=False)
    np.testing.assert_allclose(periodic["stiffness"], periodic["interfacial"], rtol=1e-6)
    # 1/k - 1/K is the mean deflection per force, between 0.5611 and 1.1222 whatever the contact.
    k, interfacial = (export.sel(periodic=False)[name] for name in ("stiffness", "interfacial_stiffness"))
    sunk = 1 / k - 1 / interfacial
    assert ((sunk > 0.56110) & (sunk < 1.12220)).all()
    assert (free["stiffness"] < free["interfacial"]).all()


def linear(rate, exponent=1.0):
    """Return what surfaces would export whose K is a power of the force, and whose tops are exponential."""
    points, force = 128, np.geomspace(1e-3, 3, 17)
    rows = [1.0, 0.5, 0.25, 0.125, 0.0625, 0.25, 0.125, 0.0625]
    every = ("row", "periodic", "sample", "load")
    shape = (8, 2, 4, 17)
    scatter = (1 + 0.01 * (-1.0) ** np.arange(4))[:, None]
    stiffness = np.broadcast_to(rate * force**exponent * scatter, shape)
    below = np.full((*shape[:3], 256), np.nan)
    for row, length in enumerate(rows):
        count = round(1 / length) ** 2
        tops = -np.log((np.arange(count) + 0.5) / count) / rate
        below[row, ..., :count] = (tops.max() - tops) * RMS
    return xarray.Dataset(
        {
            "dimensionless_force": ("load", force),
            "stiffness": (every, stiffness),
            "interfacial_stiffness": (every, stiffness),
            "contact_area": (every, np.broadcast_to(0.05 * force, shape)),
            "below": ((*every[:3], "cell"), below),
            "cell_stiffness": ((), 1e-4),
            "status": (every, np.full(shape, "converged")),
        },
        {
            "periodic": [False, True],
            "long_cutoff": ("row", [*rows[:5], *[np.nan] * 3]),
            "rolloff": ("row", [*[np.nan] * 5, *rows[5:]]),
            "points": points,
            "short_cutoff": 4 / points,
            "sample": np.arange(4),
        },
    )


def test_a_linear_law_is_found_with_its_factor_and_where_it_comes_from():
    found = outlook_flat.averages(linear(3.0))
    np.testing.assert_allclose(found["exponent"].isel(row=slice(2, None)), 1, rtol=1e-12)
    np.testing.assert_allclose(found["level"].isel(row=slice(2, None)), 3, rtol=1e-3)
    # Quantiles of 16 tops and more: the mean excess of the upper half misses what lies above the highest of them.
    np.testing.assert_allclose(found["over_decay"].isel(row=[4, 7]), 1, rtol=0.05)
    linear_law, rolled, *_ = verdicts(outlook_flat, found)
    assert (linear_law.word, rolled.word) == ("holds", "does not hold")
    FigureCanvasAgg(drawn(outlook_flat, found)).draw()


def test_another_power_is_found_to_be_none():
    found = outlook_flat.averages(linear(3.0, exponent=0.9))
    np.testing.assert_allclose(found["exponent"].isel(row=slice(2, None)), 0.9, rtol=1e-12)
    linear_law, rolled, *_ = verdicts(outlook_flat, found)
    assert (linear_law.word, rolled.word) == ("does not hold", "holds")


def test_what_was_computed_is_drawn_and_judged(found):
    FigureCanvasAgg(drawn(outlook_flat, found)).draw()
    assert len(verdicts(outlook_flat, found)) == 6
    assert "F^" in findings(outlook_flat, found)
