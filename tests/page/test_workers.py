"""Workers of the page are cancelled, killed and replaced; what they compute here takes no time."""

import asyncio
import os
from pathlib import Path
from types import SimpleNamespace

import psutil
import pytest

pytest.importorskip("starlette", reason="the page needs the extra 'page'")

import toy_worker
from roughcontact.page.frames import LENGTHS, header_of, lengths_of
from roughcontact.page.server import workers
from roughcontact.page.server.server_folder import SCRATCH
from roughcontact.page.server.workers import Sessions

PATIENCE = 60.0  # seconds


@pytest.fixture
def sessions(tmp_path, monkeypatch):
    """Those of a server whose workers are toys."""
    monkeypatch.setattr(workers, "page_worker", SimpleNamespace(__name__=toy_worker.__name__))
    monkeypatch.setenv("PYTHONPATH", os.fspath(Path(toy_worker.__file__).parent), prepend=os.pathsep)
    monkeypatch.setattr(workers, "_DELAY", 0.0)
    (tmp_path / SCRATCH).mkdir()
    return Sessions(tmp_path)


def run(sessions, act):
    """Run a coroutine function of a new session; no process is there afterwards."""

    async def acted():
        async with asyncio.timeout(PATIENCE), sessions.running():
            found = await act(sessions.known[await sessions.begin()])
            started.update(set(psutil.Process().children()) - before)
            return found

    before, started = set(psutil.Process().children()), set()  # other tests may have left a process
    found = asyncio.run(acted())
    assert [each for each in started if each.is_running() and each.status() != psutil.STATUS_ZOMBIE] == []
    return found


def ask(session, job, key="1", queue="front", **more):
    return session.perform({"job": job, "key": key, "queue": queue, "more": more})


def header(message):
    words, _ = lengths_of(message[:LENGTHS])
    return header_of(message[LENGTHS : LENGTHS + words])


async def all_of(messages):
    return [header(each) async for each in messages]


async def said(session, **asked):
    """Return the process that answers, which comes to its end."""
    first, end = await all_of(ask(session, "say", **asked))
    assert end == {"type": "end", "how": "done"}
    return first["process"]


def test_requests_are_answered_by_one_process_and_those_of_the_other_queue_by_another(sessions):
    async def act(session):
        front = [await said(session), await said(session)]
        back = [await said(session, queue="back"), await said(session, queue="back")]
        return front, back

    (first, again), (other, other_again) = run(sessions, act)
    assert first == again
    assert other == other_again
    assert first != other


@pytest.mark.parametrize(("job", "stays"), [("work", True), ("flood", True), ("ignore", False)])
@pytest.mark.parametrize("how", ["stopped", "no longer read"])
def test_a_request_that_is_cancelled_ends_and_its_process_only_if_it_must(sessions, job, stays, how):
    async def act(session):
        before = await said(session)
        messages = ask(session, job)
        assert header(await anext(messages))["type"] == "doing"
        assert session.busy
        if how == "stopped":
            rest = asyncio.create_task(all_of(messages))
            await session.front.stop("1")
            assert (await rest)[-1] == {"type": "end", "how": "stopped"}
        else:
            await messages.aclose()
        assert not session.busy
        return before, await said(session, key="2")

    before, after = run(sessions, act)
    assert (before == after) == stays


def test_a_request_that_is_stopped_before_its_turn_is_not_begun(sessions):
    async def act(session):
        await session.front.stop("early")  # overtakes its request on another connection
        assert await all_of(ask(session, "die", "early")) == [{"type": "end", "how": "stopped"}]
        first = ask(session, "work", "1")
        await anext(first)
        waiting = asyncio.create_task(all_of(ask(session, "die", "2")))
        await asyncio.sleep(0)
        await session.front.stop("2")
        await first.aclose()
        return await waiting

    assert run(sessions, act) == [{"type": "end", "how": "stopped"}]


def test_a_request_that_is_stopped_while_its_worker_starts_is_not_begun(sessions):
    async def act(session):
        answer = asyncio.create_task(all_of(ask(session, "die")))
        while not session.busy:
            await asyncio.sleep(0)
        await session.front.stop("1")
        return await answer

    assert run(sessions, act) == [{"type": "end", "how": "stopped"}]


def test_a_stop_ends_no_other_request(sessions):
    async def act(session):
        await said(session)
        await session.front.stop("1")  # too late
        await session.back.stop("2")  # of the other queue
        return await all_of(ask(session, "say", "2"))

    assert run(sessions, act)[-1] == {"type": "end", "how": "done"}


def test_a_process_that_dies_is_said_and_the_reserve_takes_its_place(sessions):
    async def act(session):
        before = await said(session)
        doing, end = await all_of(ask(session, "die"))
        assert doing == {"type": "doing"}
        reserve = (await sessions.reserve).process.pid
        return before, end, reserve, await said(session)

    before, end, reserve, after = run(sessions, act)
    assert end["how"] == "died"
    assert "A new one takes over" in end["message"]
    assert before != after == reserve


def test_a_process_that_is_killed_while_it_waits_is_replaced(sessions):
    async def act(session):
        before = await said(session)
        for worker in sessions.workers | {await sessions.reserve}:
            worker.process.kill()
            await worker.process.wait()
            await asyncio.wait({worker.listener})
        return before, await said(session)

    before, after = run(sessions, act)
    assert before != after


@pytest.mark.parametrize("executable", ["/nowhere/python", "false"])
def test_a_process_that_does_not_start_is_said(sessions, monkeypatch, executable):
    monkeypatch.setattr(workers.sys, "executable", executable)

    async def act(session):
        return await all_of(ask(session, "say"))

    [end] = run(sessions, act)
    assert end["how"] == "died"
    assert end["message"]


def test_the_processes_of_a_session_end_with_it_in_the_middle_of_a_request(sessions):
    async def act(session):
        [key] = sessions.known
        messages = [ask(session, "work", queue=queue) for queue in ("front", "back")]
        for each in messages:
            await anext(each)
        processes = [psutil.Process(each.worker.process.pid) for each in (session.front, session.back)]
        await sessions.end(key)
        assert not session.folder.exists()
        for each in messages:
            await each.aclose()
        return [each.is_running() for each in processes]

    assert run(sessions, act) == [False, False]
