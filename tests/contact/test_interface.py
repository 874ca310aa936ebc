"""The law of an interface: what of a curve stands in it, and that other programs read the same law from their texts."""

import io
import math
from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.evaluation.interface_calculix import calculix_text
from roughcontact.evaluation.interface_columns import column_text, moose_text
from roughcontact.evaluation.interface_text import abaqus_text, lammps_text
from roughcontact.theory import mindlin

STEEL, RUBBER = rc.Solid(210e9, 0.3), rc.Solid(1e7, 0.5)
P0, U0 = 2e8, 3e-7  # an exponential law p = P0 exp(-g/U0), whose stiffness is p/U0
GAPS = np.array([1.9e-6, 1.6e-6, 1.2e-6, 9e-7, 8e-7, 5e-7])


@pytest.fixture(scope="module")
def curve():
    grid = rc.Grid((64, 64), 1e-6, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1), long_cutoff=3e-5)
    return rc.loading_curve(surface, 1e11, pressures=np.geomspace(1e5, 1e9, 9))


@pytest.fixture
def exponential(curve):
    """Return the table of the exponential law."""
    pressure = P0 * np.exp(-GAPS / U0)
    table = rc.interface_table(curve, area=2.5e-7)
    return replace(
        table, pressure=pressure, gap=GAPS, stiffness=pressure / U0, contact_fraction=pressure / P0
    )


@pytest.fixture
def sheared(exponential):
    """Return the table of the exponential law for bodies with K/K_t = 1.25."""
    tangential = {"tangential_stiffness_per_area": exponential.stiffness / 1.25}
    return replace(exponential, tangential=tangential, friction=0.4)


def numbers(text, *, after, last=False):
    """Return the lines of numbers that follow a line, the first or the last of its kind."""
    lines = text.splitlines()
    found = []
    start = len(lines) - 1 - lines[::-1].index(after) if last else lines.index(after)
    for line in lines[start + 1 :]:
        if line.startswith("*"):
            break
        found.append([float(word) for word in line.split(",")])
    return np.array(found)


def words(text):
    """Return the comments of a text in one line."""
    return " ".join(line.removeprefix("** ") for line in text.splitlines())


def rows(text):
    """Return index, r, energy and force of a table for LAMMPS, and the number that its head states."""
    head, _, body = text.partition("\n\nINTERFACE\n")
    assert all(line.startswith("# ") for line in head.splitlines())
    count, blank, *lines = body.splitlines()
    assert blank == ""
    return np.array([[float(word) for word in line.split()] for line in lines]), count


class TestTable:
    def test_it_holds_the_resolved_loads_per_area(self, curve):
        table = rc.interface_table(curve)
        kept = curve.resolved
        assert 2 <= kept.sum() < len(curve)  # else this would say nothing
        np.testing.assert_array_equal(table.pressure, curve.nominal_pressure[kept])
        np.testing.assert_array_equal(table.gap, curve.mean_gap[kept])
        np.testing.assert_array_equal(table.stiffness, curve.interfacial_stiffness_per_area[kept])
        np.testing.assert_array_equal(table.contact_fraction, curve.contact_fraction[kept])
        assert table.validity == (table.pressure[0], table.pressure[-1])
        assert table.area == curve.nominal_area
        assert table.periodic

    def test_the_first_line_is_the_tangent_of_the_first_load(self, curve):
        table = rc.interface_table(curve)
        # Of a difference of gaps as long as the overclosure is: a few roundings of the gap.
        rounding = 4 * np.finfo(float).eps * table.zero_gap / table.overclosure[0]
        assert table.pressure[0] / table.overclosure[0] == pytest.approx(table.stiffness[0], rel=rounding)
        assert (np.diff(table.overclosure) > 0).all()

    def test_straight_lines_lie_above_an_exponential_by_what_is_stated(self, exponential):
        fine = np.linspace(GAPS[-1], GAPS[0], 200_001)
        chords = np.interp(fine, GAPS[::-1], exponential.pressure[::-1])
        # The largest of many evenly spaced points is below the maximum by the square of their distance: 1e-9 here.
        assert (chords / (P0 * np.exp(-fine / U0)) - 1).max() == pytest.approx(
            exponential.chord_error, rel=1e-6
        )

    def test_conductances_are_those_of_the_interface(self, curve):
        bodies = {"resistivities": (1e-7, 2e-8), "conductivities": (50.0, 160.0)}
        table = rc.interface_table(curve, **bodies)
        found = rc.conductance(curve, **bodies)
        assert set(table.conductances) == {"thermal_conductance_per_area", "electrical_conductance_per_area"}
        for name, values in table.conductances.items():
            np.testing.assert_array_equal(values, found[name][curve.resolved])
        assert rc.interface_table(curve, conductivities=(50.0, 160.0)).conductances.keys() == {
            "thermal_conductance_per_area"
        }

    def test_the_dataset_has_units(self, curve):
        dataset = rc.interface_table(curve, conductivities=(50.0, 160.0)).to_dataset()
        units = {name: values.attrs["units"] for name, values in dataset.data_vars.items()}
        assert units == {
            "nominal_pressure": "Pa",
            "mean_gap": "m",
            "overclosure": "m",
            "interfacial_stiffness_per_area": "Pa m-1",
            "contact_fraction": "1",
            "thermal_conductance_per_area": "W m-2 K-1",
            "zero_gap": "m",
        }
        np.testing.assert_array_equal(dataset["zero_gap"] - dataset["mean_gap"], dataset["overclosure"])
        low, high = curve.nominal_pressure[curve.resolved][[0, -1]]
        assert dataset.attrs["validity"] == f"nominal pressure from {low:.6g} to {high:.6g} Pa"

    def test_tangential_stiffness_is_that_of_the_bodies(self, curve):
        first, second = rc.Solid(1.5e11, 0.2), rc.Solid(3e11, 0.4)
        for bodies, ratio in (
            (second, mindlin.ratio(0.4)),
            ((first, second), mindlin.pair_ratio(first, second)),
        ):
            modulus = rc.reduced_modulus(*(bodies if isinstance(bodies, tuple) else (bodies,)))
            table = rc.interface_table(replace(curve, modulus=modulus), bodies=bodies, friction=0.3)
            tangential = table.tangential["tangential_stiffness_per_area"]
            # Moduli and ratio are sums of two numbers each: a few roundings.
            np.testing.assert_allclose(table.stiffness / tangential, ratio, rtol=1e-14)
            assert table.friction == 0.3
            dataset = table.to_dataset()
            np.testing.assert_array_equal(dataset["tangential_stiffness_per_area"], tangential)
            assert dataset["tangential_stiffness_per_area"].attrs["units"] == "Pa m-1"
        assert rc.interface_table(curve).tangential == {}
        assert rc.interface_table(curve).friction is None

    def test_bodies_are_those_of_the_curve(self, curve):
        steel = replace(curve, modulus=rc.reduced_modulus("steel", "steel"))
        named = rc.interface_table(steel, bodies=("steel", "steel"), friction=0.2)
        assert named.stiffness / named.tangential["tangential_stiffness_per_area"] == pytest.approx(
            mindlin.pair_ratio(rc.handbook("steel").solid), rel=1e-14
        )
        with pytest.raises(
            ValueError, match=r"have a reduced modulus of 1.33333e\+07 Pa, but the curve has 1e\+11"
        ):
            rc.interface_table(curve, bodies=RUBBER)
        with pytest.raises(ValueError, match=r"a Solid .* is needed, not 1"):
            rc.interface_table(curve, bodies=1e11)
        with pytest.raises(ValueError, match=r"given without the bodies.*: give `bodies` too"):
            rc.interface_table(curve, friction=0.3)
        with pytest.raises(ValueError, match="friction"):
            rc.interface_table(steel, bodies=("steel", "steel"), friction=0.0)

    def test_what_has_no_law_is_refused(self, curve):
        line = rc.self_affine(rc.Grid(64, 1e-6), hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
        profile = rc.loading_curve(line, 1e11, forces=[1.0, 2.0], operator=rc.line(line.grid, 1e11))
        with pytest.raises(ValueError, match="needs the curve of a map, not of a line: press a map"):
            rc.interface_table(profile)
        with pytest.raises(
            ValueError, match=r"needs two resolved loads, and the curve has 0: leave the loads out"
        ):
            rc.interface_table(replace(curve, stiffness=np.zeros(len(curve))))
        with pytest.raises(ValueError, match="the gap does not fall"):
            rc.interface_table(replace(curve, mean_gap=np.ones(len(curve))))
        with pytest.raises(ValueError, match="curve must be a Curve"):
            rc.interface_table([1.0])
        with pytest.raises(ValueError, match=r"area \[m\^2\]"):
            rc.interface_table(curve, area=0.0)


class TestAbaqus:
    def test_pressure_rises_with_overclosure_from_zero(self, exponential):
        found = numbers(abaqus_text(exponential), after="*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR")
        assert found[0].tolist() == [0.0, 0.0]
        np.testing.assert_array_equal(found[1:, 0], exponential.pressure)
        np.testing.assert_array_equal(found[1:, 1], exponential.overclosure)
        assert (np.diff(found, axis=0) > 0).all()

    def test_conductance_stands_before_pressure(self, curve):
        table = rc.interface_table(curve, resistivities=(1e-7, 2e-8), conductivities=(50.0, 160.0))
        text = abaqus_text(table)
        for name, keyword in (
            ("thermal_conductance_per_area", "*GAP CONDUCTANCE, PRESSURE"),
            ("electrical_conductance_per_area", "*GAP ELECTRICAL CONDUCTANCE, PRESSURE"),
        ):
            found = numbers(text, after=keyword)
            assert found[0].tolist() == [0.0, 0.0]
            np.testing.assert_array_equal(found[1:], np.transpose([table.conductances[name], table.pressure]))
        assert "*GAP" not in abaqus_text(rc.interface_table(curve))

    def test_millimetres_go_with_megapascals(self, curve):
        table = rc.interface_table(curve, resistivities=(1e-7, 2e-8), conductivities=(50.0, 160.0))
        text, si = abaqus_text(table, units="mm"), abaqus_text(table)
        for keyword, factors in (
            ("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR", (1e-6, 1e3)),
            # 1 W = 1e3 mW and 1 V = 1e3 mV over 1 m2 = 1e6 mm2.
            ("*GAP CONDUCTANCE, PRESSURE", (1e-3, 1e-6)),
            ("*GAP ELECTRICAL CONDUCTANCE, PRESSURE", (1e-9, 1e-6)),
        ):
            expected = numbers(si, after=keyword) * factors
            np.testing.assert_allclose(numbers(text, after=keyword), expected, rtol=1e-15)
        assert "** units: mm, N, MPa, mW/mm2/K, A/mV/mm2" in text

    def test_comments_say_where_it_holds_and_what_zero_is(self, exponential, curve):
        low, high = exponential.validity
        text = abaqus_text(exponential, ["made by Jörg\nin two lines", "long " * 80])
        lines = text.splitlines()
        assert (
            f"** valid from {low:.6g} to {high:.6g} Pa, 6 resolved loads; below: a straight line to zero"
            in lines
        )
        assert any(f"overclosure 0 is a mean gap of {exponential.zero_gap!r}" in line for line in lines)
        assert "** made by J?rg | in two lines" in lines
        assert max(map(len, lines)) <= 123
        assert "for loading only" not in text
        flowing = abaqus_text(replace(exponential, hardness=2e9))
        assert "no cell bears more than 2e+09 Pa" in flowing
        assert "elastic and perfectly plastic, normal load" in flowing
        assert "; elastic, normal load" in abaqus_text(exponential)
        assert "free patch" in abaqus_text(replace(exponential, periodic=False))

    def test_the_elastic_slip_gives_the_tangential_stiffness_at_the_stated_pressure(self, sheared):
        """Abaqus/Standard takes mu p over the elastic slip as its stick slope."""
        low, high = sheared.validity
        for units, factor, pascal in (("SI", 1.0, "Pa/m"), ("mm", 1e3, "MPa/mm")):
            unit = {"SI": 1.0, "mm": 1e-9}[units]
            text = abaqus_text(sheared, units=units)
            (line,) = (line for line in text.splitlines() if line.startswith("*FRICTION"))
            slip = float(line.partition("ELASTIC SLIP=")[2]) / factor
            ((friction,),) = numbers(text, after=line)
            # K = p/U0 of the exponential law is a power, which is interpolated exactly.
            middle = math.sqrt(low * high)
            assert friction * middle / slip == pytest.approx(middle / U0 / 1.25, rel=1e-13)
            assert f" {pascal} at " in text
            ends = [end / U0 / 1.25 * unit for end in (low, high)]
            assert "goes from {:.6g} to {:.6g}".format(*ends) in words(text)
        assert "*FRICTION" not in abaqus_text(replace(sheared, friction=None))


class TestCalculix:
    TABLE = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR"
    LAW = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL"

    def test_the_table_is_that_of_abaqus_in_fields_of_twenty_characters(self, exponential):
        for units in ("SI", "mm"):
            text = calculix_text(exponential, units=units)
            expected = numbers(abaqus_text(exponential, units=units), after=self.TABLE)
            # Fourteen digits.
            np.testing.assert_allclose(numbers(text, after=self.TABLE), expected, rtol=5e-14)
            fields = [
                word.strip() for line in text.splitlines() if line[0] != "*" for word in line.split(",")
            ]
            assert max(map(len, fields)) <= 20

    def test_an_exponential_law_is_found(self, exponential):
        """A hundredth of the pressure is left at the first number from where the second one acts."""
        for units, pascal, metre in (("SI", 1, 1), ("mm", 1e-6, 1e3)):
            text = calculix_text(exponential, units=units)
            ((distance, pressure),) = numbers(text, after=self.LAW)
            # The law begins at a mean gap of `zero_gap`. Least squares of six exact points lose a digit or two.
            assert distance == pytest.approx(U0 * math.log(100) * metre, rel=1e-12)
            assert pressure == pytest.approx(P0 * math.exp(-exponential.zero_gap / U0) * pascal, rel=1e-12)
        assert "whose stiffness by at most 0.0%" in words(text)
        assert f"the gap is open below {pressure:.6g} MPa" in words(text)
        other = replace(exponential, stiffness=exponential.stiffness * 1.25)
        assert "whose stiffness by at most 20.0%" in words(calculix_text(other))

    def test_both_interactions_stick_by_the_slope_of_the_middle_pressure(self, sheared):
        middle = math.sqrt(math.prod(sheared.validity))
        for units, factor in (("SI", 1.0), ("mm", 1e-9)):
            text = calculix_text(sheared, units=units)
            assert text.count("*FRICTION\n") == 2
            for last in (False, True):
                ((friction, slope),) = numbers(text, after="*FRICTION", last=last)
                assert friction == 0.4
                assert slope == pytest.approx(middle / U0 / 1.25 * factor, rel=1e-13)
        assert "*FRICTION" not in calculix_text(replace(sheared, friction=None))

    def test_a_conductance_has_twenty_lines_at_most(self, exponential):
        pressure = np.geomspace(1e6, 1e8, 30)
        joint, spots = 50.0 + pressure / 1e4, pressure / 1e4
        names = ("joint_conductance_per_area", "spots_conductance_per_area")
        many = replace(
            exponential,
            pressure=pressure,
            gap=-U0 * np.log(pressure / P0),
            stiffness=pressure / U0,
            contact_fraction=pressure / P0,
            conductances=dict(zip(names, (joint, spots), strict=True)),
        )
        found = numbers(calculix_text(many, units="mm"), after="*GAP CONDUCTANCE")
        assert len(found) == 20
        assert found[0].tolist() == [pytest.approx(0.05), 0.0]  # gas and radiation, mW/(mm^2 K)
        np.testing.assert_allclose(found[:, 0] * 1e3, 50 + found[:, 1] * 1e6 / 1e4, rtol=1e-12)
        np.testing.assert_allclose(found[[1, -1], 1], [1.0, 100.0], rtol=1e-12)
        # 29 steps to 18: each is one or two of them.
        steps = np.log(found[2:, 1] / found[1:-1, 1]) / np.log(pressure[1] / pressure[0])
        assert set(steps.round(9)) == {1.0, 2.0}
        plain = replace(many, conductances={"thermal_conductance_per_area": spots[:]})
        assert numbers(calculix_text(plain), after="*GAP CONDUCTANCE")[0].tolist() == [0.0, 0.0]
        assert "*GAP" not in calculix_text(exponential)

    def test_closings_of_less_than_a_tenth_of_a_nanometre_are_left_out_in_metres(self, exponential):
        # Closings of 0.15, 0.3, 0.5, 0.65, 0.7 and 0.85 nm, with a first one of 0.15 nm from p/K.
        smooth = replace(exponential, gap=GAPS * 5e-4, stiffness=exponential.stiffness * 2e3)
        for units, rows, metre in (("SI", [0, 1, 2, 3, 5], 1), ("mm", [0, 1, 2, 3, 4, 5], 1e3)):
            found = numbers(calculix_text(smooth, units=units), after=self.TABLE)
            np.testing.assert_allclose(found[1:, 1], smooth.overclosure[rows] * metre, rtol=1e-13)
        with pytest.raises(ValueError, match="write the table in millimetres: units='mm'"):
            calculix_text(replace(smooth, gap=GAPS * 1e-5, stiffness=exponential.stiffness * 1e5))

    def test_comments_hold_the_limits_of_calculix(self, exponential):
        text = calculix_text(exponential, ["made by hand"])
        head, _, body = text.partition("*SURFACE INTERACTION")
        assert all(line.startswith("** ") and len(line) <= 123 for line in head.splitlines())
        assert "** made by hand" in head
        assert "TYPE=NODE TO SURFACE" in head
        assert "TYPE=SURFACE TO SURFACE" in head
        assert "**" not in body


class TestColumns:
    def test_numpy_reads_all_columns_to_the_last_bit(self, curve):
        bodies = {"resistivities": (1e-7, 2e-8), "conductivities": (50.0, 160.0)}
        steel = replace(curve, modulus=rc.reduced_modulus(STEEL))
        table = rc.interface_table(steel, bodies=STEEL, **bodies)
        text = column_text(table, ["made by hand"])
        dataset = table.to_dataset()
        heads = [line.removeprefix("# ").split() for line in text.splitlines() if line[0] == "#"]
        names, units = heads[-2:]
        found = np.loadtxt(io.StringIO(text), unpack=True)
        assert names == [name for name, each in dataset.data_vars.items() if each.ndim]
        assert len(found) == len(names) == len(units) == 8
        for name, unit, values in zip(names, units, found, strict=True):
            np.testing.assert_array_equal(values, dataset[name])
            assert unit.replace("*", " ") == dataset[name].attrs["units"]
        assert "# made by hand" in text
        assert f"overclosure 0 is a mean gap of {table.zero_gap!r} m" in text

    def test_moose_finds_rising_columns_from_zero(self, sheared):
        conductances = {"thermal_conductance_per_area": sheared.pressure / 1e4}
        text = moose_text(replace(sheared, conductances=conductances))
        # As in MOOSE: what follows # is a comment, and the first line without numbers holds the names.
        lines = [line for line in text.splitlines() if not line.startswith("#")]
        found = dict(zip(lines[0].split(","), np.loadtxt(lines[1:], delimiter=",", unpack=True), strict=True))
        assert list(found) == [
            "overclosure",
            "nominal_pressure",
            "interfacial_stiffness_per_area",
            "tangential_stiffness_per_area",
            "thermal_conductance_per_area",
        ]
        for name, values in (
            ("overclosure", sheared.overclosure),
            ("nominal_pressure", sheared.pressure),
            ("interfacial_stiffness_per_area", sheared.stiffness),
            ("tangential_stiffness_per_area", sheared.stiffness / 1.25),
            ("thermal_conductance_per_area", sheared.pressure / 1e4),
        ):
            np.testing.assert_array_equal(found[name][1:], values)
        assert (np.diff(found["overclosure"]) > 0).all()
        first = [values[0] for values in found.values()]
        assert first == [0.0, 0.0, sheared.stiffness[0], sheared.stiffness[0] / 1.25, 0.0]


class TestLammps:
    def test_forces_between_the_loads_are_those_of_the_law(self, exponential):
        found, count = rows(lammps_text(exponential))
        assert count == f"N {len(found)}"
        np.testing.assert_array_equal(found[:, 0], np.arange(1, len(found) + 1))
        r, force = found[:, 1], found[:, 3]
        between = r <= GAPS[0]
        # Monotone cubics go through straight lines as they are, and a line is what ln p is here: rounding of ln p.
        expected = 2.5e-7 * P0 * np.exp(-r[between] / U0)
        np.testing.assert_allclose(force[between], expected, rtol=1e-13)
        assert (r[0], force[-1], found[-1, 2]) == (GAPS[-1], 0.0, 0.0)
        assert r[-1] == pytest.approx(exponential.zero_gap, rel=1e-15)
        tangent = 2.5e-7 * exponential.stiffness[0] * (exponential.zero_gap - r[~between])
        # The last step but one is a difference of lengths a thousand times as long: 1e-16 of these.
        np.testing.assert_allclose(force[~between], tangent, rtol=1e-12, atol=1e-18)

    def test_energy_is_the_work_of_closing(self, exponential):
        found, _ = rows(lammps_text(exponential))
        first, last = exponential.validity
        work = 2.5e-7 * (U0 * (last - first) + first**2 / (2 * exponential.stiffness[0]))
        # Simpson's rule in steps h of 2e-9 m: (h/U0)^4/2880, 1e-12; and in the step of the first load, where the
        # curvature jumps by p/U0^2, at most h^3/12 of that, which over the work is 1e-2 (h/U0)^3/12, 3e-10.
        assert found[0, 2] == pytest.approx(work, rel=1e-9)

    def test_lammps_finds_force_and_energy_consistent(self, exponential, curve):
        """As it asks itself: each force lies between the slopes of the energy on either side."""
        for table in (exponential, rc.interface_table(curve)):
            found, _ = rows(lammps_text(table))
            r, energy, force = found[:, 1:].T
            slopes = -np.diff(energy) / np.diff(r)
            assert (slopes[:-1] > force[1:-1]).all()
            assert (force[1:-1] > slopes[1:]).all()

    def test_comments_hold_the_command_and_the_cutoff(self, exponential):
        text = lammps_text(exponential)
        assert text.startswith("# UNITS: si\n")
        assert f"zlo POSITION FILE INTERFACE {exponential.zero_gap!r}" in text
        assert "force and energy of a nominal area of 2.5e-07 m2" in text
        assert math.isfinite(rows(text)[0].sum())
