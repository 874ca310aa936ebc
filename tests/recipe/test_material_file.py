"""Viscoelastic materials as TOML files with units."""

import pytest

import roughcontact as rc


def material_of(folder, text):
    (folder / "m.toml").write_text(text, encoding="utf-8")
    return rc.Viscoelastic.read(folder / "m.toml")


def test_every_field_is_read_with_its_unit(tmp_path):
    text = """
equilibrium = "3MPa"
moduli = ["2MPa", 4e6]
times = ["1ms", "2min"]
dashpot = "5kPa*s"
band = ["1ms", "1h"]
temperature = "20degC"
misfit = 0.02
"""
    wanted = rc.Viscoelastic(3e6, (2e6, 4e6), (1e-3, 120.0), 5e3, (1e-3, 3600.0), 293.15, 0.02)
    found = material_of(tmp_path, text)
    assert found.times == pytest.approx(wanted.times, rel=1e-15)
    assert found.band == pytest.approx(wanted.band, rel=1e-15)
    assert (found.equilibrium, found.moduli, found.dashpot) == (3e6, (2e6, 4e6), pytest.approx(5e3))
    assert (found.temperature, found.misfit) == (pytest.approx(293.15), 0.02)
    found.write(tmp_path / "again.toml")
    assert rc.Viscoelastic.read(tmp_path / "again.toml") == found


def test_another_modulus_is_converted(tmp_path):
    shear = rc.Viscoelastic(1e6, [2e6], [0.1])
    text = 'kind = "shear"\nequilibrium = "1MPa"\nmoduli = ["2MPa"]\ntimes = ["0.1s"]\n'
    assert material_of(tmp_path, text + "poisson = 0.5") == rc.viscoelastic.reduced(
        shear, "shear", poisson=0.5
    )
    assert material_of(tmp_path, text + 'bulk = "1GPa"') == rc.viscoelastic.reduced(shear, "shear", bulk=1e9)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('equilibrum = "1MPa"', "no field 'equilibrum'.*did you mean 'equilibrium'"),
        ('moduli = "1MPa"', "moduli must be a list"),
        ('equilibrium = ["1MPa"]', "equilibrium must be one value"),
        ('equilibrium = "1mm"', "is not a modulus"),
        ('moduli = ["1MPa"]\ntimes = ["-1s"]', "must be positive"),
        ('moduli = ["1MPa"]\ntimes = ["1s", "2s"]', "each modulus needs its time"),
        ('kind = "shear"\nequilibrium = "1MPa"', "exactly one of poisson and bulk"),
        ("equilibrium = ", "not valid TOML"),
    ],
)
def test_errors_name_the_field(tmp_path, text, message):
    with pytest.raises(ValueError, match=message):
        material_of(tmp_path, text)
