"""The Outlook's energies."""

import numpy as np
import pytest
import xarray
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact.study.study import Study
from roughcontact_thesis import outlook_energy
from roughcontact_thesis.figures import drawn, verdicts
from thesis.computed import exported


def test_the_work_of_a_cubic_force_is_exact():
    way = np.array([0.1, 0.4, 0.5, 1.2])
    coefficients = np.array([0.7, -2.0, 3.0, 1.5])
    force, stiffness, energy = (
        xarray.DataArray(np.polyval(each, way), dims="load")
        for each in (coefficients, np.polyder(coefficients), np.polyint(coefficients))
    )
    found = outlook_energy.work(force, xarray.DataArray(way, dims="load"), stiffness)
    np.testing.assert_allclose(found, np.diff(energy), rtol=1e-13)


def hertz(gap=1.0):
    """Return what two periodic spheres of sorts would export, U = 2/5 F d; `gap` is what -du is over dd."""
    force = np.geomspace(*outlook_energy.LOADS, 41)
    depth = force ** (2 / 3)
    every = ("periodic", "rolloff", "sample", "load")
    shape = (2, 2, 3, 41)

    def along(values):
        return every, np.broadcast_to(values, shape).copy()

    factor = np.where(np.array([False, True]), 1.0, gap)[:, None, None, None]
    return xarray.Dataset(
        {
            "dimensionless_force": ("load", force),
            "force": along(force),
            "depth": along(depth),
            "stiffness": along(1.5 * force / depth),
            "interfacial_stiffness": along(1.5 * force / depth / factor),
            "mean_gap": along(7 - factor * depth),
            "elastic_energy": along(0.4 * force * depth),
            "contact_area": along(1e-4 * force),
            "rms": along(0.01 + 0 * force),
            "status": (every, np.full(shape, "converged")),
        },
        {"periodic": [False, True], "rolloff": list(outlook_energy.ROLLOFF), "points": 5},
    )


def test_a_contact_whose_energy_is_known_obeys_both_equations():
    found = outlook_energy.averages(hertz())
    # Ten loads a decade: F ~ d^(3/2) through cubics of its slopes, error about (1/4)^4/720.
    np.testing.assert_allclose(found["by_approach"], 1, rtol=1e-4)
    np.testing.assert_allclose(found["by_gap"], 1, rtol=1e-4)
    np.testing.assert_allclose(found["length"].isel(load=0), 0.4 * 1e-3 ** (2 / 3) / 0.01, rtol=1e-12)
    np.testing.assert_allclose(found["area_length"] / found["length"], 1e4, rtol=1e-12)
    exact, wrong, small, *_ = verdicts(outlook_energy, found)
    assert [each.ruling.word for each in (exact, wrong, small)] == ["holds", "holds in part", "holds"]


def test_a_body_that_sinks_in_does_not_obey_that_of_the_gap():
    found = outlook_energy.averages(hertz(gap=0.8))
    np.testing.assert_allclose(found["by_gap"].sel(periodic=False), 1 / 0.8, rtol=1e-4)
    np.testing.assert_allclose(found["by_gap"].sel(periodic=True), 1, rtol=1e-4)
    # Half of the force on what it sank in, 0.2 d: the rest of the energy is 0.3 F d, its derivative 0.75 F.
    np.testing.assert_allclose(
        found["interfacial_length"].sel(periodic=False),
        0.75 * found["length"].sel(periodic=False),
        rtol=1e-10,
    )
    np.testing.assert_allclose(found["by_gap_interfacial"].sel(periodic=False), 0.75 / 0.8, rtol=1e-4)
    exact, wrong, small, *_ = verdicts(outlook_energy, found)
    assert [each.ruling.word for each in (exact, wrong, small)] == ["holds", "holds in part", "does not hold"]


@pytest.fixture(scope="module")
def export():
    study = outlook_energy.studies("small")[0]
    parameters = study.parameters | {"points": 32, "short_cutoff": 1 / 8, "loads": 9, "highest_force": 1.0}
    return exported(Study(**(dict(study) | {"samples": 2, "parameters": parameters})), seconds=True)


@pytest.mark.parametrize(
    ("way", "stiffness", "bodies"),
    [
        ("depth", "stiffness", [0, 1]),
        ("mean_gap", "interfacial_stiffness", [1]),
    ],
)
def test_the_energy_lies_between_what_a_convex_force_allows(export, way, stiffness, bodies):
    # Contact only grows with the approach: the force is convex, above its tangents and below its chords. Exact for
    # cells too; a millionth for the certificates.
    one = export.isel(periodic=bodies)
    x = np.abs((one[way] - one[way].isel(load=0)).to_numpy())
    force, slope, energy = (one[name].to_numpy() for name in ("force", stiffness, "elastic_energy"))
    step, grown = np.diff(x), np.diff(energy)
    chord = (force[..., 1:] + force[..., :-1]) / 2 * step
    (f1, f2), (k1, k2) = ((each[..., :-1], each[..., 1:]) for each in (force, slope))
    meet = np.where(k2 > k1, (f2 - k2 * step - f1) / np.where(k2 > k1, k1 - k2, 1), 0)
    meet = np.clip(
        meet, 0, step
    )  # of nearly equal slopes rounding decides where; it is a bound wherever they part
    tangents = f1 * meet + k1 * meet**2 / 2 + f2 * (step - meet) - k2 * (step - meet) ** 2 / 2
    assert (grown <= chord * (1 + 1e-6)).all()
    assert (grown >= tangents * (1 - 1e-6)).all()
    assert (tangents < 0.999 * chord).any()


def test_a_few_computed_surfaces_are_drawn_and_judged(export):
    found = outlook_energy.averages(export)
    # Three loads a decade on few cells: a staircase of the stiffness.
    np.testing.assert_allclose(found["whole_by_approach"], 1, atol=0.01)
    assert (found["by_gap"].sel(periodic=False).isel(interval=-1) > 1.5).all()
    FigureCanvasAgg(drawn(outlook_energy, found)).draw()
    assert len(verdicts(outlook_energy, found)) == 5
