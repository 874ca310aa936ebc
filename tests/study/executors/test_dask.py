"""Dask as an engine: nothing is lost with a worker, and nothing is left behind."""

import asyncio
import random
import socket
import ssl
import sys
import time

import psutil
import pytest

from roughcontact.study.case import Case
from roughcontact.study.executors import dask, submission
from roughcontact.study.executors.dask import Dask
from roughcontact.study.executors.worker import WorkersError
from study.executors.workload import FATE, NUMBERS, Numbers, bits, run_task, tasks, truth, workers

distributed = pytest.importorskip("distributed")


@pytest.fixture
def threads():
    """Return a cluster whose one worker is a thread: there at once, though it cannot be killed."""
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, protocol="tcp", dashboard_address=None
    ) as cluster:
        yield cluster


@pytest.mark.slow
def test_a_killed_worker_costs_nothing_and_a_killing_case_only_itself(monkeypatch):
    pytest.importorskip("cryptography")
    # Every task whose worker dies is put aside at once: that takes fewer new workers, which are slow to start.
    monkeypatch.setattr(dask, "FORGIVEN", 0)
    rng = random.Random(2)
    given = tasks(NUMBERS, [{"value": i, "seconds": 0.002} for i in range(200)])
    (killer,) = tasks(FATE, [{"how": "kill"}], first=200)
    kills, results = set(rng.sample(range(20, 180), 2)), []
    for result in Dask(workers=2).results(run_task, [*given[:100], killer, *given[100:]]):
        results.append(result)
        if len(results) in kills:
            time.sleep(rng.uniform(0, 0.004))
            rng.choice(workers()).kill()
    assert bits(results) == truth(given) | {killer.key: None}
    (message,) = (result.message for result in results if result.message)
    assert "its worker died in each of 2 tries" in message
    assert workers() == []


def answered(port, strangers):
    """Return what a port answers to plain text, or by TLS to the keys of somebody else; nothing if it hangs up."""
    try:
        with (
            socket.create_connection(("127.0.0.1", port), timeout=60) as plain,
            strangers.wrap_socket(plain) if strangers else plain as speaking,
        ):
            speaking.sendall(b"GET /metrics HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
            return speaking.recv(1000)
    except OSError:
        return b""


def test_nobody_without_the_keys_of_the_run_is_answered():
    pytest.importorskip("cryptography")
    results = Dask(workers=1).results(run_task, tasks(NUMBERS, [{}, {}, {}]))
    next(results)
    family = [psutil.Process(), *workers()]
    assert len(family) == 2
    listening = {
        connection.laddr
        for process in family
        for connection in process.net_connections()
        if connection.status == psutil.CONN_LISTEN
    }
    assert {place.ip for place in listening} == {"127.0.0.1"}
    others = distributed.Security.temporary()
    known, stranger = (others.get_connection_args("client") for _ in range(2))
    strangers = stranger["ssl_context"]
    strangers.verify_mode = ssl.CERT_NONE  # they take any server: what is tried is whether it takes them
    pages = {place.port for place in listening if answered(place.port, None).startswith(b"HTTP/1.1 404")}
    obedient = {place.port for place in listening} - pages
    assert (len(pages), len(obedient)) == (2, 3)  # of the scheduler and its worker; these two and the nanny
    for port in obedient:
        assert answered(port, None) == answered(port, strangers) == b""
        for address, given in (f"tcp://127.0.0.1:{port}", {}), (f"tls://127.0.0.1:{port}", known):
            with pytest.raises(OSError, match=r"closed|certificate|reset"):
                asyncio.run(distributed.connect(address, 60, **given))
    assert len(list(results)) == 2
    assert workers() == []


def test_a_scheduler_that_runs_already_is_used_and_left_alone(threads):
    given = tasks(NUMBERS, [{"value": i} for i in range(20)])
    for engine in Dask(cluster=threads), Dask(threads.scheduler_address):
        assert engine.workers == 1
        assert bits(engine.results(run_task, given)) == truth(given)
    assert threads.status.name == "running"


def test_a_scheduler_that_goes_is_told_of(threads):
    results = Dask(threads.scheduler_address).results(run_task, tasks(NUMBERS, [{"seconds": 0.1}] * 9))
    next(results)
    threads.close()
    with pytest.raises(WorkersError, match="the scheduler has ended: start it again"):
        list(results)


def test_a_scheduler_that_does_not_answer_is_told_of(monkeypatch):
    monkeypatch.setattr(submission, "ANSWER", 0.2)
    with pytest.raises(WorkersError, match="no scheduler answers at tcp"):
        list(Dask("tcp://127.0.0.1:9").results(run_task, tasks(NUMBERS, [{}])))


def test_workers_of_another_version_are_refused(threads, monkeypatch):
    from_elsewhere = Dask(threads.scheduler_address).results(run_task, tasks(NUMBERS, [{}]))
    monkeypatch.setattr(submission, "__version__", "0.0.7")
    with pytest.raises(WorkersError, match=r"this machine has 0\.0\.7"):
        list(from_elsewhere)


def test_a_case_that_cannot_be_sent_or_loaded_is_refused(threads, monkeypatch):
    engine = Dask(cluster=threads)
    with pytest.raises(WorkersError, match="'local' cannot be sent to another process"):
        list(engine.results(run_task, tasks(Case("local", 1, Numbers, lambda p, rng: None), [{}])))
    monkeypatch.setattr(submission, "pickled", lambda *_: b"cfleeting\nrun\n.")
    with pytest.raises(WorkersError, match="No module named 'fleeting'"):
        list(engine.results(run_task, tasks(NUMBERS, [{}])))


def test_starts_nothing_for_nothing():
    assert list(Dask("tcp://127.0.0.1:9").results(run_task, [])) == []


def test_what_makes_no_sense_is_refused(monkeypatch):
    with pytest.raises(ValueError, match="one of address, workers and cluster"):
        Dask("tcp://127.0.0.1:9", workers=2)
    with pytest.raises(ValueError, match="workers is 0"):
        Dask(workers=0)
    monkeypatch.setitem(sys.modules, "cryptography.x509", None)
    with pytest.raises(WorkersError, match=r"cryptography.* pip install 'roughcontact\[cluster\]'"):
        Dask(workers=2)
    assert repr(Dask("tls://127.0.0.1:9")) == "Dask('tls://127.0.0.1:9')"  # whose keys are not made here
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(WorkersError, match=r"pip install 'roughcontact\[cluster\]'"):
        Dask(workers=2)
