"""What ultrasound sees of a curve: closed forms, the stiffness of unloading, limits and notes."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.evaluation.reflection import reflection_notes
from roughcontact.theory import ultrasound

STEEL, ALUMINIUM = (rc.handbook(name) for name in ("steel", "aluminium"))
LIKE, UNLIKE = ("steel", "steel"), ("steel", "aluminium")
PRESSURES = [1e7, 1e8]


def impedance(material):
    solid = material.solid
    return ultrasound.impedance(solid.young_modulus, solid.poisson_ratio, material.density)


Z1, Z2 = impedance(STEEL), impedance(ALUMINIUM)


@pytest.fixture(scope="module")
def rough():
    grid = rc.Grid((64, 64), 4e-6, periodic=True)
    rng = np.random.default_rng(1)
    return rc.self_affine(grid, hurst=0.8, rms=1e-6, rolloff=64e-6, short_cutoff=32e-6, rng=rng)


@pytest.fixture(scope="module")
def curve(rough):
    return rc.loading_curve(rough, LIKE, pressures=PRESSURES)


def test_like_bodies_have_the_closed_forms_of_a_spring(curve):
    """Sums of a few terms: some roundings. 1 - |r|^2 is 2e-3 or more."""
    seen = rc.reflection(curve, LIKE, 5e6)
    over = 2 * curve.interfacial_stiffness_per_area / (2 * math.pi * 5e6 * Z1)
    np.testing.assert_allclose(seen["reflection"], (1 + over**2) ** -0.5, rtol=1e-14)
    np.testing.assert_allclose(seen["reflection"] ** 2 + seen["transmission"] ** 2, 1, rtol=1e-14)
    np.testing.assert_allclose(seen["error_amplification"], 1 + over**-2, rtol=1e-13)
    best = math.sqrt(2) * curve.interfacial_stiffness_per_area / (2 * math.pi * Z1)
    np.testing.assert_allclose(seen["best_frequency"], best, rtol=1e-14)
    distance = np.sqrt(256e-6**2 / curve.spots)
    wavelength = Z1 / STEEL.density / 5e6
    np.testing.assert_allclose(seen["wavelength_over_spot_distance"], wavelength / distance, rtol=1e-14)


def test_the_stiffness_follows_from_the_reflection_of_unlike_bodies(curve):
    """The inverse loses as many digits as the amplification has: 218 of 1e-16."""
    seen = rc.reflection(curve, UNLIKE, 5e6)
    square = seen["reflection"] ** 2
    w = 2 * math.pi * 5e6
    k = w * Z1 * Z2 * np.sqrt((1 - square) / (square * (Z1 + Z2) ** 2 - (Z1 - Z2) ** 2))
    np.testing.assert_allclose(k, curve.interfacial_stiffness_per_area, rtol=1e-12)
    np.testing.assert_allclose(square + Z2 / Z1 * seen["transmission"] ** 2, 1, rtol=1e-14)


@pytest.mark.parametrize("frequency", [1e5, 5e6])
def test_it_is_measurable_where_the_stiffness_can_be_inferred(curve, frequency):
    """At 5 MHz the reflection of the first load is too near 1, not at 0.1 MHz."""
    seen = rc.reflection(curve, LIKE, frequency)
    assert seen["measurable"].tolist() == [frequency == 1e5, True]
    for size, k, measurable in zip(
        seen["reflection"], curve.interfacial_stiffness_per_area, seen["measurable"], strict=True
    ):
        if measurable:
            found, _ = ultrasound.stiffness_from_reflection(size, frequency, (Z1, Z1))
            assert found == pytest.approx(k, rel=1e-12)
        else:
            with pytest.raises(rc.InputError, match="less certain"):
                ultrasound.stiffness_from_reflection(size, frequency, (Z1, Z1))


def test_the_reflection_itself_does_not_depend_on_what_can_be_inferred(curve):
    found = rc.reflection(curve, LIKE, 5e6)["reflection"]
    assert ((found > 0) & (found < 1)).all()


def test_under_a_hardness_the_wave_sees_the_stiffness_of_unloading(rough):
    curve = rc.loading_curve(rough, LIKE, pressures=PRESSURES, hardness="steel")
    k = curve.flow.unloading_interfacial_stiffness / curve.nominal_area
    assert (k > 1.1 * curve.interfacial_stiffness_per_area).all()
    found = rc.reflection(curve, LIKE, 5e6)["reflection"]
    np.testing.assert_allclose(found, np.abs(ultrasound.reflection(k, 5e6, (Z1, Z1))), rtol=1e-14)
    # A stiffness is solved to 1e-8, of which r takes a part (1 - r^2).
    alone = rc.reflection(rc.press(rough, LIKE, pressure=1e8, hardness="steel"), LIKE, 5e6)
    assert alone["reflection"] == pytest.approx(found[-1], rel=1e-8)


def test_a_state_and_a_dataset_have_the_values_of_the_curve(rough, curve):
    seen = rc.reflection(curve, UNLIKE, 5e6)
    state = rc.reflection(rc.press(rough, LIKE, pressure=1e8), UNLIKE, 5e6)
    dataset = rc.reflection(curve.to_dataset(), UNLIKE, 5e6)
    for name, values in seen.items():
        assert state[name] == pytest.approx(values[-1], rel=1e-7)
        np.testing.assert_array_equal(dataset[name], values)
    assert dataset["reflection"].attrs["long_name"].endswith(", at 5 MHz")
    again = rc.reflection(dataset, UNLIKE, 1e6)
    assert again["reflection"].attrs["long_name"].endswith(", at 1 MHz")
    np.testing.assert_array_equal(again["reflection"], rc.reflection(curve, UNLIKE, 1e6)["reflection"])


def test_full_contact_reflects_as_two_bodies_without_a_joint(rough):
    full = rc.press(rough, LIKE, pressure=1e12)
    assert full.interfacial_stiffness == np.inf
    seen = rc.reflection(full, UNLIKE, 5e6)
    assert seen["reflection"] == pytest.approx((Z1 - Z2) / (Z1 + Z2), rel=1e-14)
    assert seen["transmission"] == pytest.approx(2 * Z1 / (Z1 + Z2), rel=1e-14)
    assert not seen["measurable"]
    assert seen["error_amplification"] == seen["best_frequency"] == np.inf
    assert [note.text for note in reflection_notes(seen, 5e6)] == [
        "At 1 of 1 loads K/A0 cannot be inferred from the reflection at 5 MHz: its relative error is more than 20 "
        "times that of the reflection."
    ]


def test_densities_and_solids_in_place_of_materials(curve):
    solids = (STEEL.solid, ALUMINIUM.solid)
    named = rc.reflection(curve, UNLIKE, 5e6)
    given = rc.reflection(curve, solids, 5e6, densities=(STEEL.density, ALUMINIUM.density))
    for name, values in named.items():
        np.testing.assert_array_equal(given[name], values)
    # A material of another density: z ~ sqrt(density), so that w/K counts twice as much.
    dense = rc.reflection(curve, LIKE, 5e6, densities=(4 * STEEL.density, 4 * STEEL.density))
    light = rc.reflection(curve, LIKE, 1e7)
    np.testing.assert_allclose(dense["reflection"], light["reflection"], rtol=1e-14)


def test_notes_on_a_wave_that_is_too_short_and_their_remedies(curve):
    """Of both notes one case each: at 5 MHz one load is no good for either, at 0.5 MHz both are."""
    at_five = [*reflection_notes(rc.reflection(curve, LIKE, 5e6), 5e6)]
    assert [note.rank.name for note in at_five] == ["LIMITED", "DOUBTFUL"]
    assert all(note.text.startswith("At 1 of 2 loads") for note in at_five)
    assert "The best frequency is 140 kHz at these loads" in at_five[0].text
    assert "up to 3.2 MHz" in at_five[1].text
    at_lower = [*reflection_notes(rc.reflection(curve, LIKE, 3.2e6), 3.2e6)]
    assert [note.rank.name for note in at_lower] == ["LIMITED"]
    assert not [*reflection_notes(rc.reflection(curve, LIKE, 0.14e6), 0.14e6)]


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"frequency": 0.0}, "frequency must be positive"),
        ({"frequency": math.nan}, "frequency"),
        ({"densities": (7850.0, -1.0)}, "densities must be positive"),
        ({"densities": 7850.0}, "densities must be two"),
        ({"bodies": ("steel", "cheese")}, "no material named 'cheese'"),
        (
            {"bodies": (rc.Solid(math.inf, 0.3), "steel"), "densities": (1e3, 1e3)},
            "modulus must be positive and finite",
        ),
        ({"bodies": (rc.Solid(1e6, 0.5), "steel"), "densities": (1e3, 1e3)}, "below 0.5"),
    ],
)
def test_bad_input(curve, changed, message):
    with pytest.raises(rc.InputError, match=message):
        rc.reflection(curve, **{"bodies": LIKE, "frequency": 5e6} | changed)
