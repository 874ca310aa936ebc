"""Tables of the interface beside the files of a curve."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact import loading

PRESSURES = ("--pressures", "10MPa,30MPa,100MPa,1GPa")
LOADS = (*PRESSURES, "--modulus", "110GPa")
HEAT = ("--conductivity", "50W/m/K,160W/m/K")


@pytest.fixture
def joint(tmp_path):
    grid = rc.Grid((48, 48), 1e-6, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(2), short_cutoff=8e-6)
    rc.write(surface, tmp_path / "joint.npz")
    return tmp_path / "joint.npz"


def numbers(text):
    """Return the first and the second number of all lines that hold two."""
    pairs = [line.split(",") for line in text.splitlines() if line[0] in "0123456789"]
    return np.array(pairs, dtype=float)


def test_the_tables_are_those_of_the_library(invoke, joint, tmp_path):
    out = tmp_path / "out"
    words = ("--table", "abaqus,abaqus-mm,csv,lammps", "--table-area", "1mm^2", "--out", out)
    answer = invoke("curve", joint, *LOADS, *HEAT, *words)
    assert answer.exit_code == 0, answer.stderr
    assert "interface.inp, interface_mm.inp, interface.csv and interface.table are in" in answer.stderr
    curve = rc.read_curve(out / "curve.nc")
    table = rc.interface_table(curve, conductivities=(50.0, 160.0), area=1e-6)
    rc.write(table, tmp_path / "interface.csv")
    assert (tmp_path / "interface.csv").read_bytes() == (out / "interface.csv").read_bytes()
    for name in ("interface.inp", "interface.table"):
        rc.write(table, tmp_path / name)
        ours, theirs = ((folder / name).read_text(encoding="utf-8") for folder in (tmp_path, out))
        # What the command adds is where it comes from.
        left = [line for line in theirs.splitlines() if line not in ours.splitlines()]
        assert left
        assert all(line.startswith(("#", "**")) for line in left)
        assert [line for line in theirs.splitlines() if line not in left] == ours.splitlines()
    assert "input_sha256 = " in (out / "interface.inp").read_text()
    millimetres, metres = (
        numbers((out / name).read_text()) for name in ("interface_mm.inp", "interface.inp")
    )
    assert len(metres) == 2 * (len(table) + 1)
    np.testing.assert_allclose(
        millimetres[: len(table) + 1], metres[: len(table) + 1] * (1e-6, 1e3), rtol=1e-14
    )


@pytest.mark.parametrize(
    ("bodies", "words"),
    [
        (("steel", "aluminium"), ("--materials", "steel,aluminium")),
        (rc.Solid(210e9, 0.3), ("--young", "210GPa", "--poisson", "0.3")),
        (
            (rc.Solid(210e9, 0.3), rc.Solid(70e9, 0.33)),
            ("--young", "210GPa", "--poisson", "0.3", "--young2", "70GPa", "--poisson2", "0.33"),
        ),
    ],
)
def test_tables_with_friction_are_those_of_the_library(invoke, joint, tmp_path, bodies, words):
    out = tmp_path / "out"
    tables = {
        "abaqus": ("interface.inp", {}),
        "calculix": ("interface_ccx.inp", {"dialect": "calculix"}),
        "calculix-mm": ("interface_ccx_mm.inp", {"dialect": "calculix", "units": "mm"}),
        "moose": ("interface_moose.csv", {"dialect": "moose"}),
        "text": ("interface.txt", {}),
    }
    words = (*words, *HEAT, "--table", ",".join(tables), "--friction", "0.3", "--out", out)
    answer = invoke("curve", joint, *PRESSURES, *words)
    assert answer.exit_code == 0, answer.stderr
    curve = rc.read_curve(out / "curve.nc")
    table = rc.interface_table(curve, conductivities=(50.0, 160.0), bodies=bodies, friction=0.3)
    for name, how in tables.values():
        rc.write(table, tmp_path / name, **how)
        ours, theirs = ((folder / name).read_text(encoding="utf-8") for folder in (tmp_path, out))
        left = [line for line in theirs.splitlines() if line not in ours.splitlines()]
        assert any("input_sha256 = " in line for line in left)
        assert [line for line in theirs.splitlines() if line not in left] == ours.splitlines()
    assert "*FRICTION" in (out / "interface_ccx.inp").read_text(encoding="utf-8")


def test_a_table_that_a_program_cannot_read_is_explained_and_the_curve_is_kept(invoke, joint, tmp_path):
    surface = rc.read(joint)
    rc.write(rc.Surface(surface.heights * 1e-6, surface.grid), tmp_path / "smooth.npz")
    out = tmp_path / "out"
    loads = ("--pressures", "100Pa,300Pa,1kPa", "--modulus", "110GPa")
    words = (*loads, "--table", "csv,calculix", "--out", out)
    answer = invoke("curve", tmp_path / "smooth.npz", *words)
    assert answer.exit_code == 0
    assert "Note: no --table: the closings of all loads are less than 100 pm apart" in answer.stderr
    assert "units='mm', or --table calculix-mm" in answer.stderr
    assert not (out / "interface.csv").exists()
    assert (out / "curve.csv").exists()


@pytest.mark.usefixtures("drawn")
def test_a_curve_without_a_law_says_so_and_is_kept(invoke, joint, tmp_path):
    out = tmp_path / "out"
    words = ("--forces", "1nN,2nN", "--modulus", "110GPa", "--table", "abaqus", "--out", out)
    answer = invoke("curve", joint, *words)
    assert answer.exit_code == 0
    assert "Note: no --table: a table needs two resolved loads, and the curve has 0" in answer.stderr
    assert sorted(path.name for path in out.iterdir()) == ["curve.csv", "curve.json", "curve.nc", "curve.png"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--table", "abaqus"), "--table writes files: say where by --out"),
        (("--table", "ansys", "--out", "OUT"), "--table: there is no table 'ansys'; choose from csv, abaqus"),
        (("--table", "csv,csv", "--out", "OUT"), "name each table once"),
        (("--table", ",", "--out", "OUT"), "name each table once"),
        (("--table-area", "1mm^2", "--out", "OUT"), "--table-area needs --table"),
        (("--friction", "0.3", "--out", "OUT"), "--friction needs --table"),
        (
            ("--table", "calculix", "--friction", "0.3", "--out", "OUT"),
            "--friction needs the bodies: E* does not determine how they shear; name both by --materials",
        ),
        (("--table", "csv", "--friction", "0", "--out", "OUT"), "coefficient of friction must lie between 0"),
        (("--table", "csv", "--table-area", "1mm^2", "--out", "OUT"), "--table-area is for the table lammps"),
        (("--table", "lammps", "--table-area", "1mm", "--out", "OUT"), "'1mm' is not an area"),
        (("--table", "lammps", "--table-area", "0mm^2", "--out", "OUT"), "the area must be positive"),
    ],
)
def test_what_makes_no_sense_is_refused_before_the_work(invoke, joint, tmp_path, monkeypatch, words, message):
    monkeypatch.setattr(loading, "solutions_along", lambda *_, **__: pytest.fail("it went to work"))
    words = [tmp_path / "out" if word == "OUT" else word for word in words]
    answer = invoke("curve", joint, *LOADS, *words)
    assert answer.exit_code == 2
    assert message in answer.stderr
    assert not (tmp_path / "out").exists()
