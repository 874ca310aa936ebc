"""The conductance of a joint by its parts, along a curve; the properties of the gases against handbooks."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.evaluation.interface_text import abaqus_text
from roughcontact.fluid.fluids import _GASES
from roughcontact.labels.flux_columns import HEAT_PARTS_NAMES
from roughcontact.recipe.measured.heat_parts import GASES, gas_with

OBLONG = rc.Grid((24, 40), (4e-6, 3e-6), periodic=True)
SURFACE = rc.self_affine(OBLONG, hurst=0.8, rms=1e-6, rng=1, rolloff=60e-6, short_cutoff=24e-6)
PRESSURES = [1e7, 1e8, 2e8]
AIR = rc.Gas("air", pressure=1e5, temperature=293.15, accommodation=(0.9, 0.9))
ALL = {"conductivities": (50.0, 160.0), "gas": AIR, "emissivities": (0.2, 0.3), "film": 1e-7}


def curve_of(**given):
    return rc.loading_curve(SURFACE, 1e10, pressures=PRESSURES, measures=[rc.ConductanceParts(**given)])


@pytest.mark.parametrize("conductivities", [(50.0, 160.0), (0.5, 0.5)])  # of metals, of polymers
def test_each_load_has_the_parts_of_its_state(conductivities, tmp_path):
    given = ALL | {"conductivities": conductivities}
    curve, states = curve_of(**given), rc.loading_path(SURFACE, 1e10, pressures=PRESSURES)
    joints = [rc.joint_conductance(state, **given) for state in states]
    assert {joint.additive for joint in joints} == {conductivities[0] > 1}
    for name, attribute in HEAT_PARTS_NAMES.items():
        assert curve.measured[name].tolist() == [getattr(joint, attribute) for joint in joints]
    data = curve.to_dataset()
    assert data["joint_conductance_per_area"].attrs["units"] == "W m-2 K-1"
    assert data["conductance_interaction"].attrs["units"] == "1"
    told = [note for note in curve.notes if "do not add" in note]
    assert bool(told) == (conductivities[0] < 1)
    rc.write(curve, tmp_path / "curve.nc")
    assert rc.read_curve(tmp_path / "curve.nc").notes == curve.notes
    if told:  # worked out from the parts of the last load, the heaviest
        most = joints[-1].interaction
        assert told == [
            f"At 3 of 3 loads the parts do not add up (h l/k_s up to {most:.2g}): the conductance of "
            "the joint is solved as a whole there."
        ]
        assert all(joint.residual <= 1e-7 for joint in joints)
        # Where much of the area is in contact, the drop over the open cells is above the mean: more than the sum.
        assert joints[0].total < joints[0].parts_sum
        assert joints[-1].total > joints[-1].parts_sum


def test_the_sum_is_no_bound_but_the_drop_across_the_open_cells_gives_one():
    """On a period the mean of the displacement is 0, and 1 in contact: across the open cells 1 - u is 1/(1 - A/A0)."""
    for state in rc.loading_path(SURFACE, 1e10, pressures=PRESSURES):
        joint = rc.joint_conductance(state, conductivities=(0.5, 0.5), gas=AIR)
        drop = 1 - state.problem.operator.apply(state.frozen.tangent)
        assert drop[~state.contact].mean() == pytest.approx(1 / (1 - state.contact_fraction), rel=1e-6)
        bound = joint.spots + np.mean(joint.gas_cells * drop**2)  # by Dirichlet's principle
        assert joint.total < bound


def test_a_drop_that_is_missed_and_radiation_are_noted():
    curve = curve_of(conductivities=(50.0, 160.0), emissivities=(1.0, 1.0), temperature=600.0)
    assert not any("Radiation" in note for note in curve.notes)
    curve.measured["conductance_residual"][1] = np.nan
    curve.measured["radiation_conductance_per_area"][:] = 0.02 * curve.measured["joint_conductance_per_area"]
    assert any(note.startswith("The drop across the joint is met to nan") for note in curve.notes)
    assert any(note.startswith("Radiation counts here") for note in curve.notes)


def test_in_vacuum_only_the_spots_conduct():
    curve = curve_of(conductivities=(50.0, 160.0))
    bare = rc.conductance(curve, conductivities=(50.0, 160.0))["thermal_conductance_per_area"]
    np.testing.assert_allclose(curve.measured["joint_conductance_per_area"], bare, rtol=1e-14)
    assert not curve.measured["gas_conductance_per_area"].any()


REFUSED = [
    ({"conductivities": (0.0, 50.0)}, "an insulator"),
    ({"gas": rc.Gas("air", pressure=1e5)}, "accommodation at both walls"),
    ({"gas": AIR, "emissivities": (0.2, 0.2), "temperature": 300.0}, "has a temperature already"),
    ({"emissivities": (0.2, 0.2)}, "radiation depends on the temperature"),
    ({"emissivities": (0.2, 1.2), "temperature": 300.0}, "an emissivity is at most 1"),
    ({"film": -1e-7}, "must have a finite resistance"),
]


@pytest.mark.parametrize(("given", "words"), REFUSED)
def test_what_makes_no_sense_is_refused_before_any_load(given, words):
    given = {"conductivities": (50.0, 160.0)} | given
    with pytest.raises(ValueError, match=words):
        rc.ConductanceParts(**given)
    with pytest.raises(ValueError, match=words):
        rc.joint_conductance(rc.press(SURFACE, 1e10, pressure=1e7), **given)


def test_tables_of_the_interface_take_the_whole_joint():
    """Without load, gas and radiation conduct what they do at the lowest load."""
    curve = curve_of(**ALL)
    table = rc.interface_table(curve, resistivities=(1e-7, 1e-7), conductivities=(50.0, 160.0))
    joint, spots = (
        curve.measured[f"{name}_conductance_per_area"][curve.resolved] for name in ("joint", "spots")
    )
    assert table.conductances.keys() == {
        *("spots_conductance_per_area", "joint_conductance_per_area", "electrical_conductance_per_area")
    }
    assert "spots, gas and radiation" in table.to_dataset()["joint_conductance_per_area"].attrs["long_name"]
    for units, factor, stress in (("SI", 1.0, 1.0), ("mm", 1e-3, 1e-6)):
        text = abaqus_text(table, units=units)
        assert "** the gap conductance is that of spots, gas and radiation together" in text
        lines = text.partition("*GAP CONDUCTANCE, PRESSURE\n")[2].partition("*")[0].split()
        found = np.array([line.rstrip(",") for line in lines], dtype=float).reshape(-1, 2)
        np.testing.assert_allclose(found[:, 0], factor * np.array([joint[0] - spots[0], *joint]), rtol=1e-14)
        np.testing.assert_allclose(found[1:, 1], table.pressure * stress, rtol=1e-14)
    bare = rc.loading_curve(SURFACE, 1e10, pressures=PRESSURES)
    alone = abaqus_text(rc.interface_table(bare, conductivities=(50.0, 160.0)))
    assert "gas and radiation" not in alone
    assert "*GAP CONDUCTANCE, PRESSURE\n0.0, 0.0\n" in alone


@pytest.mark.parametrize(
    ("name", "viscosities", "conductivities"),
    [
        ("air", (13.3, 18.6, 23.1, 27.1, 30.8), (18.4, 26.2, 33.3, 39.7, 45.7)),
        ("nitrogen", (12.9, 17.9, 22.2, 26.1, 29.6), (18.7, 26.0, 32.3, 38.3, 44.0)),
        ("helium", (15.3, 20.0, 24.4, 28.4, 32.3), (119.3, 156.7, 190.6, 222.3, 252.4)),
        ("argon", (15.9, 22.9, 28.8, 34.2, 39.0), (12.4, 17.9, 22.6, 26.8, 30.6)),
    ],
)
def test_gases_are_those_of_the_handbook(name, viscosities, conductivities):
    """CRC Handbook, "Viscosity of gases" [uPa s], "Thermal conductivity of gases" [mW/(m K)], at 200 K to 600 K.

    The values at 300 K are those of the table. The limits are what the docstring of `Gas` states of the others.
    """
    gases = [rc.Gas(name, temperature=kelvin) for kelvin in (200, 300, 400, 500, 600)]
    np.testing.assert_allclose([each.viscosity * 1e6 for each in gases], viscosities, rtol=0.04)
    np.testing.assert_allclose([each.conductivity * 1e3 for each in gases], conductivities, rtol=0.07)
    assert gases[1].viscosity * 1e6 == pytest.approx(viscosities[1], rel=1e-14)
    assert gases[1].conductivity * 1e3 == pytest.approx(conductivities[1], rel=1e-14)


def test_a_gas_is_read_in_any_order_and_in_part():
    gas_of = gas_with("pressure", "temperature", "accommodation")
    whole = gas_of("air,1bar,20degC,alpha=0.9:0.8")
    assert str(whole) == 'rc.Gas("air", pressure=100000.0, temperature=293.15, accommodation=(0.9, 0.8))'
    assert dict(gas_of("air, alpha=0.9:0.8, 293.15K, 1bar").named) == dict(whole.named)
    assert dict(gas_with("accommodation")("helium,alpha=0.4").named) == {"accommodation": (0.4, 0.4)}
    assert str(gas_with("temperature")("argon,300K")) == 'rc.Gas("argon", temperature=300.0)'
    with pytest.raises(
        ValueError, match="states the pressure of the gas, which is not used here: leave it out"
    ):
        gas_with("temperature")("argon,1bar,300K")
    assert tuple(_GASES) == GASES
