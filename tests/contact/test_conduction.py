"""What a contact conducts."""

import numpy as np
import pytest

import roughcontact as rc

MODULUS = 3e10


@pytest.fixture(scope="module")
def disc():
    """A flat circular spot, whose resistance Holm gave in closed form."""
    grid = rc.RadialGrid.uniform(200, 1e-5)
    return rc.press(rc.RadialProfile(np.zeros(200), grid), MODULUS, force=1.0)


def test_holm(disc):
    """R = (rho1 + rho2)/(4a), and thermally (1/l1 + 1/l2)/(4a); the rings' edge costs a part of 1/n."""
    found = rc.conductance(disc, resistivities=(1.7e-8, 5e-8), conductivities=(400.0, 20.0), of="total")
    assert found["electrical_resistance"] == pytest.approx(6.7e-8 / 4e-5, rel=2e-3)
    assert found["thermal_resistance"] == pytest.approx((1 / 400 + 1 / 20) / 4e-5, rel=2e-3)
    assert found["electrical_conductance"] * found["electrical_resistance"] == pytest.approx(1, rel=1e-15)


def test_an_insulator_conducts_nothing(disc):
    found = rc.conductance(disc, conductivities=(400.0, 0.0), of="total")
    assert found["thermal_conductance"] == 0
    assert found["thermal_resistance"] == np.inf
    assert set(found) == {"thermal_conductance", "thermal_resistance"}


def test_along_a_curve():
    grid = rc.Grid((64, 64), 1e-6)
    rough = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(0))
    curve = rc.loading_curve(rough, MODULUS, forces=np.geomspace(1e-3, 1e-1, 5))
    whole = rc.conductance(curve, resistivities=(1e-8, 1e-8), of="total")
    interface = rc.conductance(curve, resistivities=(1e-8, 1e-8))
    np.testing.assert_allclose(whole["electrical_conductance"], curve.stiffness / MODULUS / 1e-8, rtol=1e-14)
    assert (interface["electrical_resistance"] < whole["electrical_resistance"]).all()
    assert (np.diff(whole["electrical_resistance"]) <= 0).all()


def test_of_the_interface_also_per_area():
    """Sums of products: each number is the patch's over, or times, the same area, to a rounding or two."""
    rough = rc.self_affine(rc.Grid((32, 16), 1e-6), hurst=0.8, rms=1e-7, rng=np.random.default_rng(0))
    area = 32e-6 * 16e-6
    curve = rc.loading_curve(rough, MODULUS, pressures=[1e6, 1e7])
    given = {"resistivities": (1e-8, 2e-8), "conductivities": (16.0, 160.0)}
    for contact in (curve, rc.press(rough, MODULUS, pressure=1e7)):
        found = rc.conductance(contact, **given)
        for name in ("electrical", "thermal"):
            conductance, resistance = found[f"{name}_conductance"], found[f"{name}_resistance"]
            np.testing.assert_allclose(found[f"{name}_conductance_per_area"], conductance / area, rtol=1e-15)
            np.testing.assert_allclose(found[f"{name}_resistance_per_area"], resistance * area, rtol=1e-15)
        assert not any("per_area" in name for name in rc.conductance(contact, **given, of="total"))
    # h_c = 2 k1 k2/(k1 + k2) K/(E* A0)
    h_c = 2 * 16 * 160 / 176 * curve.interfacial_stiffness_per_area / MODULUS
    np.testing.assert_allclose(
        rc.conductance(curve, **given)["thermal_conductance_per_area"], h_c, rtol=1e-14
    )


def test_columns_say_what_they_are_of_and_take_the_place_of_others():
    from roughcontact.evaluation.conduction import Conductors, with_conductance

    copper = Conductors((1.7e-8, 1.7e-8))
    words = {}
    for periodic in (False, True):
        grid = rc.Grid((8, 8), 1e-6, periodic)
        curve = rc.loading_curve(rc.Surface(np.eye(8) * 1e-7, grid), MODULUS, forces=[1e-3, 1e-2])
        interface = with_conductance(curve.to_dataset(), copper)
        total = with_conductance(interface, copper, of="total")
        assert "electrical_resistance_per_area" in interface
        assert "electrical_resistance_per_area" not in total
        assert interface.electrical_resistance.long_name.endswith("of the interface only")
        words[periodic] = total.electrical_resistance.long_name
        same = np.array_equal(interface.electrical_resistance, total.electrical_resistance)
        assert same is periodic
    assert "its spreading resistance included" in words[False]
    assert "has no spreading resistance" in words[True]


def test_springs_have_no_interface():
    grid = rc.Grid(8, 1e-6)
    line = rc.Surface(np.arange(8) * 1e-9, grid)
    springs = rc.press(line, MODULUS, force=1.0, operator=rc.foundation(grid, MODULUS))
    with pytest.raises(ValueError, match="use of='total'"):
        rc.conductance(springs, resistivities=(1e-8, 1e-8))
    assert rc.conductance(springs, resistivities=(1e-8, 1e-8), of="total")["electrical_resistance"] > 0


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({}, "give the resistivities"),
        ({"resistivities": (-1.0, 1.0)}, "resistivity"),
        ({"resistivities": (0.0, 0.0)}, "no limit"),
        ({"conductivities": (np.inf, np.inf)}, "no limit"),
        ({"conductivities": (1.0, np.nan)}, "conductivity"),
        ({"conductivities": (1.0, 1.0), "of": "depth"}, "of must be"),
        ({"resistivities": 1e-8}, "of both bodies"),
        ({"resistivities": (1e-8,)}, "of both bodies"),
        ({"conductivities": (1.0, 1.0, 1.0)}, "of both bodies"),
    ],
)
def test_nonsense_is_refused(disc, given, message):
    with pytest.raises(ValueError, match=message):
        rc.conductance(disc, **given)


def test_a_line_has_none():
    grid = rc.Grid(8, 1e-6)
    line = rc.press(
        rc.Surface(np.arange(8) * 1e-9, grid), MODULUS, force=1.0, operator=rc.line(grid, MODULUS)
    )
    with pytest.raises(ValueError, match="line contact"):
        rc.conductance(line, resistivities=(1e-8, 1e-8))


def test_what_is_no_contact_is_refused():
    with pytest.raises(ValueError, match="press the surface first"):
        rc.conductance(rc.Grid(8, 1.0), resistivities=(1e-8, 1e-8))


def test_what_gives_way_conducts_too():
    """A region conducts whatever its pressure: all in contact, at any hardness, like a flat punch of its shape."""
    grid = rc.Grid((32, 32), 1e-6)
    rough = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(0))
    hard = rc.press(rough, MODULUS, force=1e-1, hardness=5e8)
    assert (hard.pressure == 5e8).any()
    punch = rc.contact_stiffness(hard.contact, grid, MODULUS)
    found = rc.conductance(hard, resistivities=(1e-8, 1e-8), of="total")["electrical_conductance"]
    assert found == pytest.approx(punch / MODULUS / 1e-8, rel=1e-12)
    assert hard.stiffness < 0.9 * punch
    interface = rc.conductance(hard, resistivities=(1e-8, 1e-8), of="interface")
    assert interface["electrical_conductance"] > found


def test_a_curve_under_a_hardness_conducts_as_its_solutions_do():
    from roughcontact.evaluation.conduction import Conductors, with_conductance

    grid = rc.Grid((32, 32), 1e-6)
    rough = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(0))
    given = {"forces": [3e-2, 1e-1], "hardness": 5e8}
    curve, path = rc.loading_curve(rough, MODULUS, **given), list(rc.loading_path(rough, MODULUS, **given))
    for of in ("interface", "total"):
        expected = [
            float(rc.conductance(each, resistivities=(1e-8, 1e-8), of=of)["electrical_conductance"])
            for each in path
        ]
        found = rc.conductance(curve, resistivities=(1e-8, 1e-8), of=of)["electrical_conductance"]
        np.testing.assert_allclose(found, expected, rtol=1e-9)
        dataset = with_conductance(curve.to_dataset(), Conductors((1e-8, 1e-8)), of)
        np.testing.assert_array_equal(dataset.electrical_conductance, found)


def test_a_curve_that_leaves_out_its_plastic_cells_does_not_know():
    """As one that was written before curves held the stiffness of unloading."""
    from dataclasses import replace

    from roughcontact.evaluation.conduction import Conductors, with_conductance

    grid = rc.Grid((8, 8), 1e-6)
    curve = rc.loading_curve(rc.Surface(np.eye(8) * 1e-7, grid), MODULUS, forces=[1e-3, 1e-2], hardness=1e10)
    curve = replace(curve, flow=None)
    with pytest.raises(ValueError, match="the plastic cells conduct"):
        rc.conductance(curve, resistivities=(1e-8, 1e-8))
    dataset = curve.to_dataset()
    assert dataset.hardness == 1e10
    with pytest.raises(ValueError, match="the plastic cells conduct"):
        with_conductance(dataset, Conductors((1e-8, 1e-8)))
    with pytest.raises(ValueError, match="of must be"):
        with_conductance(dataset, Conductors((1e-8, 1e-8)), of="depth")


def test_of_the_dataset_of_a_curve_it_is_further_columns():
    grid = rc.Grid((8, 8), 1e-6)
    curve = rc.loading_curve(rc.Surface(np.eye(8) * 1e-7, grid), MODULUS, forces=[1e-3, 1e-2])
    for of in ("interface", "total"):
        found = rc.conductance(curve, conductivities=(50.0, 200.0), of=of)
        dataset = rc.conductance(curve.to_dataset(), conductivities=(50.0, 200.0), of=of)
        assert set(dataset.data_vars) == set(curve.to_dataset().data_vars) | set(found)
        for name, values in found.items():
            np.testing.assert_array_equal(dataset[name], values)
            assert dataset[name].attrs["units"]


def test_an_insulator_has_a_picture():
    """Its resistance is infinite, and has no place on the axis."""
    from roughcontact.plot.canvas import resistance_figure

    grid = rc.Grid((8, 8), 1e-6)
    curve = rc.loading_curve(rc.Surface(np.eye(8) * 1e-7, grid), MODULUS, forces=[1e-3, 1e-2])
    for of in ("interface", "total"):
        dataset = rc.conductance(curve.to_dataset(), conductivities=(1.0, 0.0), of=of)
        resistance_figure(dataset).canvas.draw()
