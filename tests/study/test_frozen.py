"""What is on the disks of users: a key that changes has all that they computed before computed anew."""

import json
import shutil
from pathlib import Path

import pytest
import xarray

from roughcontact.study.cases import CASES
from roughcontact.study.run import run
from roughcontact.study.run_task import run_task
from roughcontact.study.store import Store
from roughcontact.study.study import Study
from study.frozen.make import GIVEN, LAW, STORED, fingerprint, keys

FROZEN = Path(__file__).parent / "frozen"
KEYS = json.loads((FROZEN / "keys.json").read_text())


@pytest.fixture
def old(tmp_path):
    """Return a function that copies a store of the build before recipes: a study half of which is computed."""

    def copied(name):
        return shutil.copytree(FROZEN / name, tmp_path / name)

    return copied


def test_every_case_is_frozen():
    assert KEYS["cases"].keys() == CASES.keys() == GIVEN.keys()


@pytest.mark.parametrize("name", GIVEN)
def test_canonical_parameters_and_keys_stay_as_they_were(name):
    assert keys(name) == KEYS["cases"][name]


@pytest.mark.parametrize("name", KEYS["law"])
def test_the_ensembles_of_the_law_go_on(name):
    assert fingerprint(Study.read(LAW / f"{name}.toml")) == KEYS["law"][name]


@pytest.mark.parametrize("name", STORED)
def test_a_store_of_an_earlier_build_opens_and_goes_on(name, old):
    folder = old(name)
    with Store.open(folder) as store:
        before, rows = store.summary(), list(store.rows())
    assert (before.done, before.failed, before.left) == (before.total / 2, 0, before.total / 2)
    summary = run(Study.read(folder / "study.toml"), folder)
    assert (summary.done, summary.left) == (before.total, 0)
    with Store.open(folder) as store:
        assert store.outdated() == 0
        assert list(store.rows())[: len(rows)] == rows  # the first sample comes first


def test_an_earlier_record_is_what_is_computed_today(old):
    with Store.open(old("lines")) as store:  # a count of springs: no rounding
        row, task = next(store.rows()), next(store.study.tasks())
    xarray.testing.assert_identical(run_task(task).record, row.record)
