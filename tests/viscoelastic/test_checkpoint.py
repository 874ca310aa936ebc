"""A history that is stopped goes on from its file, and gives the same numbers to the last bit."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.labels.column import names_of
from roughcontact.labels.viscoelastic_columns import VISCOELASTIC_CURVE
from roughcontact.viscoelastic import growing_curve

RUBBER = rc.Viscoelastic(1e6, (4e6, 5e6), (0.1, 1.0))
FREE = rc.self_affine(rc.Grid((32, 24), 1e-6), 0.8, 1e-7, rng=1, rolloff=1.5e-5, short_cutoff=6e-6)
PERIODIC = rc.self_affine(rc.Grid((16, 16), 1e-6, periodic=True), 0.8, 1e-7, rng=1)
BALL = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
LINE = rc.self_affine(rc.Grid(64, 1e-6, periodic=True), 0.8, 1e-7, rng=1)
UP_AND_DOWN = {"times": [0, 0, 1, 1, 2], "forces": [0, 1e-5, 2e-5, 5e-6, 5e-6]}
CASES = {  # with jumps of either sign, a held load, and without contact at the end
    "adapted": (FREE, RUBBER, UP_AND_DOWN | {"time_tolerance": 0.05}),
    "fixed": (BALL, RUBBER, UP_AND_DOWN | {"steps": 3}),
    "periodic": (PERIODIC, RUBBER, UP_AND_DOWN | {"time_tolerance": 0.05}),
    "depth": (BALL, RUBBER, {"times": [0, 1, 1, 2], "depths": [0, 1e-7, 2e-7, -1e-8], "steps": 3}),
    "dashpot": (BALL, rc.viscoelastic.kelvin_voigt(1e6, 1e6), UP_AND_DOWN | {"time_tolerance": 0.05}),
    "line": (
        *(LINE, RUBBER),
        {"times": [0, 0, 1], "pressures": [0, 1e4, 1e4], "steps": 4, "operator": rc.line(LINE.grid, 1e7)},
    ),
}
COLUMNS = names_of(VISCOELASTIC_CURVE[("time",)])


class Stopping:
    """A measure that interrupts the computation at one of the states."""

    def __init__(self, at=0):
        self.left = at
        self.count = 0

    def __repr__(self):
        return "Stopping()"  # two of them are the same measure

    def __call__(self, solution):
        self.count += 1
        self.left -= 1
        if not self.left:
            raise KeyboardInterrupt
        return {"fraction": solution.contact_fraction}


def stopped(case, path, at):
    surface, material, given = CASES[case]
    with pytest.raises(KeyboardInterrupt):
        rc.viscoelastic_curve(surface, material, **given, measures=[Stopping(at)], checkpoint=path)


@pytest.mark.parametrize("case", CASES)
def test_a_history_that_is_stopped_gives_the_same_numbers(case, tmp_path):
    surface, material, given = CASES[case]
    whole, path = rc.viscoelastic_curve(surface, material, **given), tmp_path / "part.npz"
    for at in (2, len(whole) // 3, len(whole) // 2, len(whole)):
        path.unlink(missing_ok=True)
        stopped(case, path, at)
        measure = Stopping()
        found = rc.viscoelastic_curve(surface, material, **given, measures=[measure], checkpoint=path)
        # The state at which it was stopped is computed again, and of an adapted step also its first half.
        assert measure.count <= len(whole) - at + 2
        for name in COLUMNS:
            np.testing.assert_array_equal(getattr(found, name), getattr(whole, name), err_msg=name)
        np.testing.assert_array_equal(found.measured["fraction"], whole.contact_fraction)
        assert found.notes == whole.notes
    again = Stopping()
    found = rc.viscoelastic_curve(surface, material, **given, measures=[again], checkpoint=path)
    assert (len(found), again.count) == (len(whole), 0)


def test_a_program_that_is_killed_goes_on_from_the_last_write(tmp_path, monkeypatch):
    monkeypatch.setattr(growing_curve, "_EVERY", 0.0)
    surface, material, given = CASES["fixed"]
    path, copies = tmp_path / "part.npz", []

    class Copying:
        """A measure that is the same whatever it has copied."""

        def __repr__(self):
            return "Copying()"

        def __call__(self, solution):
            copies.append(path.read_bytes() if path.exists() else b"")
            return {}

    measure = Copying()
    whole = rc.viscoelastic_curve(surface, material, **given, measures=[measure], checkpoint=path)
    assert copies[0] == b""
    path.write_bytes(copies[4])
    calls = len(copies)
    found = rc.viscoelastic_curve(surface, material, **given, measures=[measure], checkpoint=path)
    assert len(copies) == calls + len(whole) - 4
    np.testing.assert_array_equal(found.depth, whole.depth)


@pytest.mark.parametrize(
    "other",
    [
        {"tolerance": 1e-9},
        {"steps": 4},
        {"times": [0, 0, 1, 1, 3]},
        {"surface": rc.Surface(BALL.heights * 2, BALL.grid)},
        {"material": RUBBER.shifted(2.0)},
        {"operator": rc.layer(BALL.grid, RUBBER.instantaneous, 1e-5, base="rigid-frictionless")},
        {"measures": []},
    ],
    ids=lambda other: next(iter(other)),
)
def test_another_computation_begins_at_its_beginning(other, tmp_path):
    path = tmp_path / "part.npz"
    stopped("fixed", path, 5)
    surface, material, given = CASES["fixed"]
    asked = {"surface": surface, "material": material, "measures": [Stopping()], **given} | other
    found = rc.viscoelastic_curve(**asked, checkpoint=path)
    alone = rc.viscoelastic_curve(**asked)
    np.testing.assert_array_equal(found.force, alone.force)
    if asked["measures"]:
        assert asked["measures"][0].count == 2 * len(alone)


def test_other_numbers_of_one_name_are_computed_again(tmp_path):
    """Functions without a name of their own differ by what they do, and by what they enclose."""
    surface, material, given = CASES["fixed"]

    def measured(measure):
        found = rc.viscoelastic_curve(
            surface, material, **given, measures=[measure], checkpoint=tmp_path / "part.npz"
        )
        return found.measured["number"][-1] / found.contact_fraction[-1]

    def times(factor):
        return lambda solution: {"number": factor * solution.contact_fraction}

    assert measured(lambda solution: {"number": 2 * solution.contact_fraction}) == 2
    assert measured(lambda solution: {"number": 3 * solution.contact_fraction}) == 3
    assert [measured(times(factor)) for factor in (4, 5)] == [4, 5]


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"rubbish" * 100])
def test_a_damaged_file_is_replaced(content, tmp_path):
    path = tmp_path / "part.npz"
    path.write_bytes(content)
    surface, material, given = CASES["fixed"]
    first = rc.viscoelastic_curve(surface, material, **given, checkpoint=path)
    stored = path.read_bytes()
    assert stored != content
    assert len(rc.viscoelastic_curve(surface, material, **given, checkpoint=path)) == len(first)
    assert path.read_bytes() == stored  # nothing is computed, and nothing written
