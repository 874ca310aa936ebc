"""Tables of what was measured at a joint: columns by name, in any order and unit, with and without errors."""

import numpy as np
import pytest

import roughcontact as rc

ROWS = "5, 11, 5\n10, 21, 4\n"


def read(folder, text, quantity="stiffness", **named):
    (folder / "joint.csv").write_text(text)
    return rc.read_joint_table(folder / "joint.csv", quantity, **named)


@pytest.mark.parametrize(
    ("header", "rows", "errors"),
    [
        ("pressure [MPa], stiffness [N/um/mm^2], error [%]", ROWS, [0.05, 0.04]),
        ("# lapped joint\n# p (MPa), K/A0 (N/um/mm^2), error", "5, 11, 0.05\n10, 21, 0.04\n", [0.05, 0.04]),
        (
            "stiffness [GPa/mm];error [GPa/mm];nominal pressure [bar]",
            "11;0.55;50\n21;0.84;100\n",
            [0.05, 0.04],
        ),
        (
            "Pressure [Pa]\tInterfacial stiffness per area [Pa/m]",
            "5e6\t11e12\n10e6\t21e12\n",
            None,
        ),
    ],
)
def test_a_table_of_stiffnesses(tmp_path, header, rows, errors):
    found = read(tmp_path, f"{header}\n{rows}")
    np.testing.assert_allclose(found.pressures, [5e6, 10e6], rtol=1e-15)
    np.testing.assert_allclose(found.values, [11e12, 21e12], rtol=1e-15)
    if errors is None:
        assert found.given_errors is None
    else:
        np.testing.assert_allclose(found.errors, errors, rtol=1e-14)


def test_columns_that_the_file_does_not_name(tmp_path):
    found = read(tmp_path, "5 11\n10 21\n", columns="p [MPa], stiffness [N/um/mm^2]")
    assert found.values.tolist() == [11e12, 21e12]
    over = read(tmp_path, "p [Pa], stiffness [Pa/m]\n5, 11\n", columns="pressure [MPa], stiffness [GPa/mm]")
    assert over.pressures.tolist() == [5e6]


@pytest.mark.parametrize(("unit", "errors"), [("nm", [1e-8, 2e-8]), ("%", [2e-7, 8e-7])])
def test_errors_of_closures_are_lengths(tmp_path, unit, errors):
    found = read(tmp_path, f"pressure [MPa], closure [um], error [{unit}]\n5, 2, 10\n10, 4, 20\n", "closure")
    np.testing.assert_allclose(found.values, [2e-6, 4e-6], rtol=1e-15)
    np.testing.assert_allclose(found.errors, errors, rtol=1e-14)


def test_reflections_and_their_errors_are_ratios(tmp_path):
    found = read(tmp_path, "p [MPa], reflection [%], error [%]\n5, 96, 0.5\n10, 90, 0.5\n", "reflection")
    np.testing.assert_allclose([*found.values, *found.errors], [0.96, 0.9, 0.005, 0.005], rtol=1e-15)


def test_a_last_line_without_an_end_is_reported(tmp_path):
    with pytest.warns(rc.SurfaceWarning, match="may be cut short"):
        read(tmp_path, "pressure [MPa], stiffness [GPa/mm]\n5, 11\n10, 21")


@pytest.mark.parametrize(
    ("quantity", "head", "option"),
    [("stiffness", "stiffness [N/um/mm^2]", "errors"), ("closure", "closure [um]", "resolution")],
)
def test_a_table_without_errors_names_the_option_that_gives_them(tmp_path, quantity, head, option):
    path = tmp_path / "joint.csv"
    path.write_text(f"pressure [MPa], {head}\n7, 1.0\n15, 1.3\n")
    found = rc.read_joint_table(path, quantity)
    with pytest.raises(
        ValueError, match=f"no column of errors, and `{option}` is not given.*give `{option}`"
    ):
        _ = found.errors
