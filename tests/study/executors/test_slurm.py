"""SLURM as an engine, played by two small scripts that run what is submitted to them on this machine."""

import os
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import psutil
import pytest

from roughcontact.study.executors import slurm
from roughcontact.study.executors.keys import keys_in
from roughcontact.study.executors.slurm import Slurm
from roughcontact.study.executors.worker import WorkersError
from study.executors.workload import NUMBERS, bits, perform, tasks, truth

pytest.importorskip("dask_jobqueue")
pytest.importorskip("cryptography")
distributed = pytest.importorskip("distributed")
config = pytest.importorskip("dask.config")
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="SLURM runs on Linux")

SBATCH = """#!/bin/bash
[ "$1" = --test-only ] && { grep -q "SBATCH -p short" || { echo "no such partition" >&2; exit 1; }; exit; }
cp "$1" {folder}/job.sh
setsid bash {folder}/job.sh > {folder}/log 2>&1 < /dev/null &
echo "Submitted batch job $!"
"""
SCANCEL = """#!/bin/bash
kill -- "-$1"
"""


@pytest.fixture
def options(tmp_path, monkeypatch):
    """Return the options of a job, where sbatch and scancel are scripts."""
    for name, text in ("sbatch", SBATCH), ("scancel", SCANCEL):
        (tmp_path / name).write_text(text.replace("{folder}", os.fspath(tmp_path)))
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.chdir(tmp_path)
    return {"cores": 2, "memory": "2 GB", "queue": "short", "scheduler_options": {"host": "127.0.0.1"}}


def test_cases_are_computed_in_jobs_that_are_cancelled_in_the_end(options, tmp_path):
    given = tasks(NUMBERS, [{"value": i} for i in range(20)])
    assert bits(Slurm(2, **options).outcomes(perform, given)) == truth(given)
    script = (tmp_path / "job.sh").read_text()
    assert "--nthreads 1" in script
    assert "--nworkers 2" in script
    assert "--no-dashboard --dashboard-address 127.0.0.1:0" in script
    assert "ROUTES='[]'" in script
    assert "SPILL=False" in script
    assert f"--protocol tls:// --tls-ca-file {tmp_path}/.roughcontact-keys-" in script
    assert list(tmp_path.glob(".roughcontact-keys-*")) == []
    deadline = time.monotonic() + 30
    while any(
        os.fspath(tmp_path) in " ".join(p.info["cmdline"] or []) for p in psutil.process_iter(["cmdline"])
    ):
        assert time.monotonic() < deadline
        time.sleep(0.1)


def test_keys_lie_where_their_user_alone_can_read_them_for_as_long_as_the_run(tmp_path):
    with keys_in(os.fspath(tmp_path)) as security:
        paths = {*security.get_tls_config_for_role("worker").values()} - {None}
        assert {os.path.dirname(path) for path in paths} == {os.fspath(each) for each in tmp_path.iterdir()}
        (folder,) = tmp_path.iterdir()
        modes = [os.stat(each).st_mode & 0o777 for each in (folder, *paths)]
        assert modes == [0o700, 0o600, 0o600]
        for role in "client", "scheduler", "worker":
            assert security.get_connection_args(role)["require_encryption"]
            assert "BEGIN PRIVATE KEY" in Path(security.get_tls_config_for_role(role)["key"]).read_text()
    assert list(tmp_path.iterdir()) == []


def test_security_of_ones_own_is_kept(options, monkeypatch):
    monkeypatch.setitem(sys.modules, "cryptography.x509", None)
    given = distributed.Security(require_encryption=False)
    job = Slurm(2, **options, security=given)._job
    assert job["security"] is given
    assert "shared_temp_directory" not in job


def test_a_folder_for_keys_that_a_job_cannot_name_is_refused_with_another_way(options, tmp_path, monkeypatch):
    spaced = tmp_path / "a study"
    spaced.mkdir()
    monkeypatch.chdir(spaced)
    with pytest.raises(WorkersError, match=r"a study'.* give shared_temp_directory="):
        Slurm(2, **options)
    assert Slurm(2, **options, shared_temp_directory="..")._job["shared_temp_directory"] == str(tmp_path)
    with config.set({"jobqueue.slurm.shared-temp-directory": "$HERE/keys"}):
        monkeypatch.setenv("HERE", "/shared")
        assert Slurm(2, **options)._job["shared_temp_directory"] == "/shared/keys"


def test_a_refused_job_is_told_of(options):
    with pytest.raises(WorkersError, match="SLURM refuses the jobs: no such partition"):
        list(Slurm(2, **options | {"queue": "long"}).outcomes(perform, tasks(NUMBERS, [{}])))


def test_a_job_must_know_its_cores_and_its_memory(options):
    with pytest.raises(WorkersError, match="the cores and the memory of a job are not known"):
        Slurm(2, **options | {"cores": None})
    with config.set({"jobqueue.slurm.cores": 3}):
        engine = Slurm(2, **options | {"cores": None})
    assert engine._job["processes"] == 3


def test_a_job_that_has_ended_is_submitted_again(monkeypatch):
    now, done = [0.0], []
    monkeypatch.setattr(slurm, "time", SimpleNamespace(monotonic=lambda: now[0]))
    cluster = SimpleNamespace(
        worker_spec={"job-0": {"group": ["-0", "-1"]}, "job-1": {"group": ["-0", "-1"]}, "job-2": {}},
        scheduler_info={"workers": {"a": {"name": "job-0-0"}, "b": {"name": "job-1-1"}}},
        sync=lambda function, jobs: function(jobs),
        scale_down=lambda jobs: done.append(("ended", jobs)),
    )
    jobs = slurm._Jobs(cluster, 6)
    monkeypatch.setattr(slurm._Jobs, "submit", lambda _: done.append("submitted"))
    jobs.keep()
    del cluster.scheduler_info["workers"]["b"]
    now[0] = slurm.AWAY
    jobs.keep()
    assert done == []  # one that was not seen yet waits in the queue
    now[0] += 1
    jobs.keep()
    jobs.keep()
    assert done == [("ended", ["job-1"]), "submitted"]


def test_what_is_missing_is_told_of(options, monkeypatch):
    with pytest.raises(ValueError, match="workers is 0"):
        Slurm(0, **options)
    monkeypatch.setitem(sys.modules, "cryptography.x509", None)
    with pytest.raises(WorkersError, match=r"cryptography.* pip install 'roughcontact\[cluster\]'"):
        Slurm(2, **options)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(WorkersError, match="there is no sbatch here"):
        Slurm(2, **options)
    monkeypatch.setitem(sys.modules, "dask_jobqueue", None)
    with pytest.raises(WorkersError, match=r"pip install 'roughcontact\[cluster\]'"):
        Slurm(2, **options)
