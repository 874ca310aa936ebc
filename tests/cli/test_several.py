"""One command on several files."""

import dataclasses
import json

import pytest

import roughcontact as rc
from roughcontact.contact import loading

LOADS = ("--forces", "1mN,2mN", "--modulus", "1GPa")


@pytest.fixture
def maps(rough, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "other.npz").write_bytes(rough.read_bytes())
    (tmp_path / "more").mkdir()
    (tmp_path / "more" / "rough.npz").write_bytes(rough.read_bytes())
    return tmp_path


def test_each_file_has_a_row(invoke, maps):
    answer = invoke("surface", "info", "rough.npz", "other.npz")
    head, *rows = answer.stdout.splitlines()
    assert answer.exit_code == 0
    assert head.split() == ["file", "cells", "size", "missing", "rms", "height", "lowest", "highest", "suspicious",
                            "status"]  # fmt: skip
    assert [row.split()[0] for row in rows] == ["rough.npz", "other.npz"]
    assert all("24 x 32" in row and row.endswith("ok") for row in rows)


def test_a_file_that_fails_keeps_its_row_and_sets_the_status(invoke, maps):
    answer = invoke("surface", "info", "rough.npz", "none.npz", "other.npz")
    assert answer.exit_code == 2
    assert [row.split()[-1] for row in answer.stdout.splitlines()[1:]] == ["ok", "failed", "ok"]
    assert "Error: none.npz: it cannot be opened" in answer.stderr
    found = json.loads(invoke("surface", "info", "rough.npz", "none.npz", "--json").stdout)
    assert [each["file"] for each in found] == ["rough.npz", "none.npz"]
    assert found[0]["shape"] == [24, 32]
    assert found[1]["error"]["kind"] == "read"


def test_curves_of_several_files_have_folders_of_their_own(invoke, maps):
    answer = invoke("curve", "rough.npz", "other.npz", *LOADS, "--out", "o")
    assert answer.exit_code == 0
    alone = json.loads(invoke("curve", "rough.npz", *LOADS, "--json").stdout)
    for name in ("rough", "other"):
        stored = json.loads((maps / "o" / name / "curve.json").read_text())
        assert stored["stiffness"] == alone["stiffness"]
    found = json.loads(invoke("curve", "rough.npz", "more/rough.npz", *LOADS, "--out", "p", "--json").stdout)
    assert [each["stiffness"] for each in found] == [alone["stiffness"]] * 2
    assert sorted(path.name for path in (maps / "p").iterdir()) == ["1-rough.npz", "2-rough.npz"]


def test_a_load_that_misses_its_tolerance_is_the_status(invoke, maps, monkeypatch):
    path = loading.solutions_along

    def stagnating(*given, **named):
        return (dataclasses.replace(each, status=rc.Status.STAGNATED) for each in path(*given, **named))

    monkeypatch.setattr(loading, "solutions_along", stagnating)
    answer = invoke("curve", "rough.npz", "other.npz", *LOADS)
    assert answer.exit_code == 1
    assert answer.stdout.count("tolerance missed") == 2


def test_ctrl_c_ends_with_the_files_that_are_done(invoke, maps, monkeypatch):
    from roughcontact.plot import preparation_warnings

    looked = preparation_warnings.preparation_warnings
    seen = []

    def interrupted(surface):
        seen.append(surface)
        if len(seen) == 2:
            raise KeyboardInterrupt
        return looked(surface)

    monkeypatch.setattr(preparation_warnings, "preparation_warnings", interrupted)
    answer = invoke("surface", "info", "rough.npz", "other.npz", "more/rough.npz")
    assert answer.exit_code == 130
    assert [row.split()[-1] for row in answer.stdout.splitlines()[1:]] == ["ok", "stopped"]


def test_other_commands_take_one_file(invoke, maps):
    answer = invoke("press", "rough.npz", "other.npz", "--force", "1N", "--modulus", "1GPa")
    assert answer.exit_code == 2
    assert "unexpected argument 'other.npz'" in answer.stderr
