"""The picture of a measured joint: points, errors and bands are those of the inference, in the units asked for."""

from functools import cache

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.measurement import inference_dataset

P = np.array([7e6, 15e6, 30e6, 65e6, 140e6])
GIVEN = {"modulus": 115e9, "modulus_error": 0.02, "area": 2e-4, "branch": "loading"}
STIFFNESS = rc.infer_joint(rc.JointStiffness(P, 1.9e7 * P**0.88, 0.05, gain=0.03), **GIVEN)
CLOSURE = rc.infer_joint(rc.JointClosures(P, P**0.12 / 0.12 / 1.9e7, 1e-8), **GIVEN)


@pytest.fixture(autouse=True, scope="module")
def _closures_predicted_once():
    """Those of 4000 joints take seconds, and the same joints are drawn each time."""
    quantiles = inference_dataset.closure_quantiles
    known = cache(lambda found, shares, *pressures: quantiles(found, np.array(pressures), list(shares)))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            inference_dataset,
            "closure_quantiles",
            lambda found, pressures, shares: known(found, tuple(shares), *pressures),
        )
        yield


@pytest.mark.parametrize(
    ("found", "units", "labels", "factors"),
    [
        (
            STIFFNESS,
            {},
            ("nominal pressure [MPa]", "interfacial stiffness per area K/A0 [N/µm/mm²]"),
            (1e-6, 1e-12),
        ),
        (
            STIFFNESS,
            {
                "nominal_pressure": rc.plot.Scale(1e-5, "bar"),
                "interfacial_stiffness_per_area": rc.plot.Scale(1e-9, "GPa/m"),
            },
            ("nominal pressure [bar]", "interfacial stiffness per area K/A0 [GPa/m]"),
            (1e-5, 1e-9),
        ),
        (CLOSURE, {}, ("nominal pressure [MPa]", "closure since the first load [µm]"), (1e-6, 1e6)),
        (
            CLOSURE,
            {"closure": rc.plot.Scale(1e9, "nm")},
            ("nominal pressure [MPa]", "closure since the first load [nm]"),
            (1e-6, 1e9),
        ),
    ],
)
def test_points_and_bands_are_those_of_the_inference(found, units, labels, factors):
    axes = found.plot(units=units)
    assert (axes.get_xlabel(), axes.get_ylabel()) == labels
    closures = found is CLOSURE
    assert axes.get_xscale() == "log"
    assert axes.get_yscale() == ("linear" if closures else "log")
    [bars] = axes.containers
    dataset = found.to_dataset()
    name = "closure" if closures else "interfacial_stiffness_per_area"
    values, errors = dataset[name].to_numpy(), dataset[f"{name}_error"].to_numpy()
    np.testing.assert_allclose(bars.lines[0].get_xdata(), P * factors[0], rtol=1e-12)
    np.testing.assert_allclose(bars.lines[0].get_ydata(), values * factors[1], rtol=1e-12)
    [caps] = bars.lines[2]
    ends = np.array([[segment[0][1], segment[1][1]] for segment in caps.get_segments()]).T
    np.testing.assert_allclose(ends, np.stack([values - errors, values + errors]) * factors[1], rtol=1e-12)
    assert [text.get_text() for text in axes.get_legend().get_texts()] == [
        *("50% of such joints", "90% of such joints", "median", "measured")
    ]
    for band, level in zip(axes.collections, (0.5, 0.9), strict=False):
        outline = band.get_paths()[0].vertices
        at_end = outline[np.isclose(outline[:, 0], P[-1] * factors[0])][:, 1] / factors[1]
        expected = [dataset[f"predicted_{end}_{100 * level:.0f}"].to_numpy()[-1] for end in ("low", "high")]
        # Other draws of the same distribution, whose standard deviation is 8 % of the value. The end of 90 % of 4000
        # draws has a standard error of 3.3 % of it: 4.5 times that of the difference of two.
        assert [at_end.min(), at_end.max()] == pytest.approx(expected, rel=4.5 * 2**0.5 * 0.033 * 0.08)


def test_the_table_holds_what_was_measured():
    found = STIFFNESS.to_dataset()
    np.testing.assert_allclose(found["interfacial_stiffness_per_area"], STIFFNESS.data.stiffness, rtol=1e-12)
    errors = found["interfacial_stiffness_per_area_error"] / found["interfacial_stiffness_per_area"]
    np.testing.assert_allclose(errors, np.hypot(0.05, 0.03), rtol=1e-12)
    assert found["posterior"].sel(parameter="rms", share=0.5) == STIFFNESS.parameters[0].posterior[1]
    assert found["effective_height_low_90"] == STIFFNESS.interval(0.9)[0]
    closures = CLOSURE.to_dataset()
    assert closures["closure"].to_numpy()[0] == 0
    np.testing.assert_allclose(closures["closure"][1:], CLOSURE.data.measured, rtol=1e-12)
    # Both ends of a closure have the error of the resolution.
    np.testing.assert_allclose(closures["closure_error"][1:], np.sqrt(2) * 1e-8, rtol=1e-12)
    assert closures["closure"].attrs["units"] == "m"


def test_the_closures_of_such_joints_are_the_integrals_of_their_compliances():
    """The median of int dp/K, with K a power law between neighbouring medians of K: to a percent, as K ~ p^0.9."""
    p = np.geomspace(P[0], P[-1], 40)
    _, k, _ = CLOSURE.predicted(p)
    _, closure, _ = CLOSURE.predicted_closures(p)
    by_hand = np.sum(np.diff(p) / np.sqrt(k[1:] * k[:-1]))
    assert closure[-1] == pytest.approx(by_hand, rel=0.02)
    low, _, high = CLOSURE.predicted_closures(p)
    assert (low[1:] < closure[1:]).all()
    assert (closure[1:] < high[1:]).all()
