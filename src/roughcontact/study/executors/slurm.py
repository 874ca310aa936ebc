"""Workers that are jobs of a SLURM cluster, through Dask."""

from __future__ import annotations

import os
import shutil
import subprocess
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from roughcontact.study.executors.farm import Site, farmed
from roughcontact.study.executors.keys import NO_PAGES, as_folder, keys_in, require_keys
from roughcontact.study.executors.worker import WorkersError, require_cluster

if TYPE_CHECKING:
    from dask_jobqueue import SLURMCluster

    from roughcontact.study.task import Outcome, Perform, Task

__all__ = ["Slurm"]

AWAY = 60.0  # [s] without any of its workers, after which a job has ended
UNSEEN = "127.0.0.1:0"  # of the servers for status pages, which Dask starts in any case
WORKER_SETTINGS = (
    "export DASK_DISTRIBUTED__WORKER__HTTP__ROUTES='[]'",
    # Nothing pickled lies in a folder for temporary files, which another user may have made before.
    "export DASK_DISTRIBUTED__WORKER__MEMORY__TARGET=False DASK_DISTRIBUTED__WORKER__MEMORY__SPILL=False",
)


class Slurm:
    """Executor that submits jobs to SLURM, has cases computed in them, and cancels them in the end.

    Parameters
    ----------
    workers : int
        How many cases are computed at once. A job takes as many of them as it has cores.
    **options
        Of `dask_jobqueue.SLURMCluster`: ``cores`` and ``memory`` of a job, ``queue``, ``account``, ``walltime``,
        ``interface``, ``job_extra_directives``, ``log_directory``, ``security`` ... What is not given is taken from
        Dask's configuration, ``~/.config/dask/jobqueue.yaml``. Each worker has one thread.

    Raises
    ------
    WorkersError
        If dask-jobqueue or cryptography is not installed, there is no SLURM, cores and memory of a job are not known,
        or a job could not name the folder of the keys.

    Notes
    -----
    Scheduler and workers talk by TLS, with keys that are made for the run. During the run they lie where only the user
    can read them, in ``shared_temp_directory``, by default the current folder, which all nodes must see. With
    ``security`` of your own none are made.

    A job that has ended, at its time limit for example, is submitted again. Otherwise as `Dask`.

    Examples
    --------
    Where jobs can be submitted:

    >>> import roughcontact as rc
    >>> executor = rc.study.Slurm(48, cores=24, memory="48 GB", walltime="04:00:00")  # doctest: +SKIP
    >>> rc.study.run(rc.study.Study.read("hurst.toml"), "hurst", executor)  # doctest: +SKIP
    >>> outcomes = executor.outcomes(rc.study.perform, [])  # doctest: +SKIP
    """

    def __init__(self, workers: int, **options: Any) -> None:
        if workers < 1:
            raise ValueError(f"workers is {workers}; at least one is needed")
        require_cluster("dask_jobqueue", "dask-jobqueue")
        if shutil.which("sbatch") is None:
            raise WorkersError("there is no sbatch here: run the study where jobs can be submitted")
        self._workers = workers
        self._options = options
        self._job = _complete(options)

    def __repr__(self) -> str:
        options = "".join(f", {name}={value!r}" for name, value in self._options.items())
        return f"Slurm({self._workers}{options})"

    @property
    def workers(self) -> int:
        """How many tasks are computed at once, when all jobs run."""
        return self._workers

    def outcomes(self, perform: Perform, tasks: Iterable[Task]) -> Iterator[Outcome]:
        """Yield one outcome for each task, in the order in which they are done.

        Parameters
        ----------
        perform : function
            Takes a task and returns its outcome; it never raises.
        tasks : iterable of Task
            The tasks, which are taken one by one as workers become free.

        Yields
        ------
        Outcome
            One for each task.

        Raises
        ------
        WorkersError
            If SLURM refuses the jobs, or their workers cannot load the case.
        """
        return farmed(self._opened, perform, tasks)

    @contextmanager
    def _opened(self) -> Iterator[Site]:
        import dask.config
        from dask_jobqueue import SLURMCluster

        job = self._job
        keys = nullcontext(job["security"]) if "security" in job else keys_in(job["shared_temp_directory"])
        with (
            dask.config.set(NO_PAGES),
            keys as security,
            SLURMCluster(**job | {"security": security}) as cluster,
        ):
            jobs = _Jobs(cluster, self._workers)
            jobs.submit()
            yield Site(cluster, jobs.keep)


def _complete(options: dict[str, Any]) -> dict[str, Any]:
    """Return options by which every worker has one thread, and no page that shows what it does."""
    import dask.config

    def configured(name: str, default: Any) -> Any:
        found = options.get(name)
        if found is None:
            section = options.get("config_name", "slurm")
            found = dask.config.get(f"jobqueue.{section}.{name.replace('_', '-')}", None)
        return default if found is None else found

    cores = configured("cores", None)
    if cores is None or configured("memory", None) is None:
        raise WorkersError(
            "the cores and the memory of a job are not known: give them, as in Slurm(48, cores=24, memory='48 GB'), or "
            "write them to ~/.config/dask/jobqueue.yaml"
        )
    if "security" not in options:
        require_keys()
        options = options | {
            "shared_temp_directory": as_folder(configured("shared_temp_directory", os.getcwd()))
        }
    hidden = {"dashboard": False, "dashboard_address": UNSEEN}
    return (
        {"silence_logs": "critical"}
        | options
        | {
            "processes": cores,
            "scheduler_options": hidden | configured("scheduler_options", {}),
            "worker_extra_args": [
                *("--no-dashboard", "--dashboard-address", UNSEEN),
                *configured("worker_extra_args", []),
            ],
            "job_script_prologue": [*WORKER_SETTINGS, *configured("job_script_prologue", [])],
        }
    )


@dataclass(slots=True)
class _Jobs:
    """The jobs of a cluster, as many as it takes for so many workers."""

    cluster: SLURMCluster
    workers: int
    seen: dict[str, float] = field(default_factory=dict)  # when a job last had a worker

    def submit(self) -> None:
        """Submit what jobs are missing."""
        # The cluster submits on its own time, and tells nobody when SLURM says no.
        trial = subprocess.run(
            ["sbatch", "--test-only"],
            input=self.cluster.job_script(),
            capture_output=True,
            text=True,
            check=False,
        )
        if trial.returncode:
            raise WorkersError(f"SLURM refuses the jobs: {trial.stderr.strip()}")
        self.cluster.scale(self.workers)

    def keep(self) -> None:
        """Submit again what has ended."""
        now = time.monotonic()
        here = {worker["name"] for worker in list(self.cluster.scheduler_info["workers"].values())}
        for job, spec in self.cluster.worker_spec.items():
            if not here.isdisjoint(f"{job}{member}" for member in spec.get("group", [""])):
                self.seen[job] = now
        ended = [job for job, time in self.seen.items() if now > time + AWAY]
        if ended:
            for job in ended:
                del self.seen[job]
            self.cluster.sync(self.cluster.scale_down, ended)
            self.submit()
