"""The Outlook's tangential contacts."""

import numpy as np
import pytest
import xarray
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact.study.study import Study
from roughcontact.theory.joints import mindlin
from roughcontact.theory.stiffness_laws import pohrt_popov
from roughcontact_thesis import outlook_tangential
from roughcontact_thesis.figures import drawn, verdicts
from thesis.computed import exported

RMS = 0.01
FORCE = np.geomspace(3e-3, 0.3, 9)


def export(stiffer=1.0, further=1.0):
    """Return what contacts would export that obey eqs 7.4 to 7.6 but for these factors of k_t and displacement."""
    hurst, nu = np.array(outlook_tangential.HURST), np.array(outlook_tangential.POISSON)
    disc = (2 - nu) / (2 * (1 - nu))
    pulled = np.arange(1, 11) / 10
    shape = (3, 3, 4, 9)
    stiffness = np.array([pohrt_popov.stiffness(FORCE * RMS, h, RMS, 1.0, 1.0) for h in hurst])
    depth = np.array([pohrt_popov.depth(FORCE * RMS, h, RMS, 1.0, 1.0) for h in hurst])
    part = 1 - np.array([(1 - pulled) ** (h / (h + 1)) for h in hurst])
    scatter = (1 + 0.002 * (-1.0) ** np.arange(4))[:, None]

    def along(values, power=1):
        return np.broadcast_to(values[:, None, None, :], shape) * scatter**power

    tangential = stiffer * along(stiffness) / disc[:, None, None]
    moved = further * outlook_tangential.FRICTION * along(depth, -1) * disc[:, None, None]
    every = ("hurst", "poisson_ratio", "sample", "load")
    return xarray.Dataset(
        {
            "dimensionless_force": ("load", FORCE),
            "force": (every, np.broadcast_to(FORCE * RMS, shape)),
            "depth": (every, along(depth, -1)),
            "stiffness": (every, along(stiffness)),
            "dimensionless_stiffness": (every, along(stiffness)),
            "tangential_stiffness": (every, tangential),
            "principal_stiffness": ((*every, "principal"), tangential[..., None] * [0.9, 1.1]),
            "tangential_displacement": ((*every, "pull"), moved[..., None] * part[:, None, None, None, :]),
            "pulled": ("pull", pulled),
            "cell_stiffness": ((), 1e-4),
            "status": (every, np.full(shape, "converged")),
        },
        {"hurst": hurst, "poisson_ratio": nu, "sample": np.arange(4), "points": 5},
    )


def test_contacts_that_obey_the_laws_are_found_to():
    found = outlook_tangential.averages(export())
    np.testing.assert_allclose(found["ratio"], 1, rtol=1e-12)
    np.testing.assert_allclose(found["axes"], 1.1 / 0.9, rtol=1e-12)
    np.testing.assert_allclose(found["tangential"], found["by_7_5"], rtol=1e-12)
    # The mean of 1.002 and 0.998 is 1, that of their inverses not quite.
    np.testing.assert_allclose(found["slip"], found["by_7_6"], rtol=5e-6)
    np.testing.assert_allclose(found["slip_by_depth"], 1, rtol=1e-12)
    # What is stiffer by a factor sinks in less by it: a power law between loads, of which the cubics are exact.
    known = found["path_by_depth"].notnull()
    assert known.isel(pull=-1).all()
    assert not known.isel(load=0, pull=0).any()
    np.testing.assert_allclose(
        found["path"].where(known, 0), found["path_by_depth"].where(known, 0), rtol=1e-10
    )
    ratio, stiffness, slip, law, printed, way = verdicts(outlook_tangential, found)
    assert [each.word for each in (ratio, stiffness, slip, law, way)] == ["holds"] * 5
    # The printed constants are those of a zeta up to 18 % below 1.7/(H + 1).
    assert printed.word == "holds"
    FigureCanvasAgg(drawn(outlook_tangential, found)).draw()


def test_contacts_that_do_not_are_found_not_to():
    found = outlook_tangential.averages(export(stiffer=0.7, further=1.4))
    np.testing.assert_allclose(found["ratio"], 1 / 0.7, rtol=1e-12)
    np.testing.assert_allclose(found["slip_by_depth"], 1.4, rtol=1e-12)
    ratio, stiffness, slip, law, _, way = verdicts(outlook_tangential, found)
    assert [each.word for each in (ratio, stiffness, slip, law, way)] == ["does not hold"] * 5


@pytest.mark.parametrize("hurst", [0.4, 1.0])
def test_the_laws_are_those_of_the_thesis(hurst):
    found = outlook_tangential.averages(export()).sel(hurst=hurst, poisson_ratio=0.3)
    theta, load, ratio = RMS, RMS * FORCE, 1.7 / 1.4
    # Eqs 7.5, 7.6 with Z of eq. 7.7, and the Z that goes with eq. 7.2, written out; L = E* = 1.
    zeta, power = 1.7 / (hurst + 1), 1 / (hurst + 1)
    np.testing.assert_allclose(found["by_7_5"], zeta * (load / theta) ** power / ratio, rtol=1e-12)
    printed = (hurst + 1) / (0.2055 * hurst) * (0.086 * theta) ** power
    np.testing.assert_allclose(
        found["by_7_7"] * RMS, ratio * printed * load ** (hurst / (hurst + 1)), rtol=1e-12
    )
    consistent = (hurst + 1) / (zeta * hurst) * theta**power
    np.testing.assert_allclose(
        found["by_7_6"] * RMS, ratio * consistent * load ** (hurst / (hurst + 1)), rtol=1e-12
    )
    assert float(found["disc"]) == pytest.approx(mindlin.ratio(0.3))


def test_a_few_computed_contacts():
    (study,) = outlook_tangential.studies("small")
    parameters = study.parameters | {"points": 32, "loads": 3, "pulls": 4}
    table = {"hurst": (0.7, 1.0), "poisson_ratio": (0.0, 0.3)}
    given = {"samples": 2, "parameters": parameters, "table": table}
    found = outlook_tangential.averages(exported(Study(**(dict(study) | given)), seconds=True))
    smooth = found.sel(poisson_ratio=0.0)
    np.testing.assert_allclose(smooth["ratio"], 1, rtol=1e-8)
    np.testing.assert_allclose(smooth["axes"], 1, rtol=1e-8)
    # Without Poisson's ratio the largest displacement is mu d, to the certificates.
    np.testing.assert_allclose(smooth["slip_by_depth"], 1, rtol=1e-5)
    other = found.sel(poisson_ratio=0.3)
    assert (other["axes"] > 1).all()
    assert (other["axes"] < 1 / 0.7).all()
    assert (np.diff(found["path"], axis=-1) > 0).all()
