"""A study is the same, bit for bit, whichever engine computed it and whatever befell its workers."""

import random

import pytest

from roughcontact.study import Dask, Processes, Serial, Store, Study, run
from roughcontact.study.export import export
from study.executors.workload import workers

STUDY = Study(
    name="engines", case="study.executors.workload:RECORD", samples=35, table={"value": [0, 1, 2, 3, 4, 5]}
)


def exported(folder, executor, on_result=None):
    """Return every bit of what a study exports, and what it has to say of itself."""
    summary = run(STUDY, folder, executor, on_result=on_result)
    assert (summary.done, summary.failed, summary.left) == (175, 35, 0)
    with Store.open(folder) as store:
        found = export(store)
    variables = found.variables.items()
    return {name: (each.dims, each.attrs, each.values.tobytes()) for name, each in variables}, found.attrs


@pytest.fixture(scope="module")
def truth(tmp_path_factory):
    return exported(tmp_path_factory.mktemp("serial"), Serial())


def test_processes_that_are_killed_at_random_export_what_serial_execution_does(truth, tmp_path):
    rng, count = random.Random(3), iter(range(210))
    kills = set(rng.sample(range(200), 2))

    def kill(_):
        if next(count) in kills:
            rng.choice(workers()).kill()

    assert exported(tmp_path, Processes(2), kill) == truth
    assert next(count, None) is None


def test_dask_exports_what_serial_execution_does(truth, tmp_path):
    pytest.importorskip("distributed")
    pytest.importorskip("cryptography")
    assert exported(tmp_path, Dask(workers=1)) == truth
