"""Connections to the page: quick, and closed where nothing comes of them or who opened them has no key."""

import asyncio
import contextlib
import socket

import pytest

pytest.importorskip("starlette", reason="the page needs the extra 'page'")
pytest.importorskip("uvicorn", reason="the page needs the extra 'page'")

from roughcontact.page.server.guard import Guard
from roughcontact.page.server.page_app import PageServer, application
from roughcontact.page.server.serve import _bound, _web
from roughcontact.page.server.workers import Sessions

PATIENCE = 60.0  # seconds
SILENT = 1.0  # seconds that a new connection is given here


@pytest.fixture
def serving(tmp_path, monkeypatch):
    """Return a function that has a coroutine function speak to the page, which starts no workers."""
    monkeypatch.setattr(Sessions, "_start", lambda _: asyncio.Event().wait())

    async def served(speak):
        with _bound(0) as listening:
            port = listening.getsockname()[1]
            (tmp_path / "page").mkdir()
            web = _web(application(PageServer(Guard(port, "key"), Sessions(tmp_path / "page"))), SILENT)
            running = asyncio.create_task(web.serve(sockets=[listening]))
            while not web.started:
                await asyncio.sleep(0.01)
            try:
                async with asyncio.timeout(PATIENCE):
                    return await speak(web, port)
            finally:
                web.should_exit = True
                await running

    return lambda speak: asyncio.run(served(speak))


@contextlib.asynccontextmanager
async def connection(port):
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    try:
        yield reader, writer
    finally:
        writer.close()
        with contextlib.suppress(ConnectionError):
            await writer.wait_closed()


def request(port, method="GET", path="/", key="key", more=""):
    return (
        f"{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nCookie: roughcontact-{port}={key}\r\n{more}\r\n"
    ).encode()


async def answered(reader):
    """Return the status of an answer, all of which is read, and whether it says that the connection ends."""
    head = (await reader.readuntil(b"\r\n\r\n")).decode().lower()
    [length] = [line.partition(":")[2] for line in head.split("\r\n") if line.startswith("content-length:")]
    await reader.readexactly(int(length))
    return int(head.split()[1]), "\r\nconnection: close\r\n" in head


def test_answers_do_not_wait_for_the_acknowledgement_of_what_went_before(serving):
    async def speak(web, port):
        async with connection(port) as (reader, writer):
            writer.write(request(port))
            assert await answered(reader) == (200, False)
            [each] = web.server_state.connections
            plug = each.transport.get_extra_info("socket")
            return plug.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)

    assert serving(speak) != 0


def test_a_connection_that_brings_no_request_is_closed_and_one_that_did_is_kept(serving):
    async def speak(_, port):
        async with contextlib.AsyncExitStack() as opened:
            reader, writer = await opened.enter_async_context(connection(port))
            writer.write(request(port))
            assert await answered(reader) == (200, False)
            silences = []
            for begun in b"", b"GET / HT", b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n":
                silence, silent = await opened.enter_async_context(connection(port))
                silent.write(begun)
                silences.append(silence)
            assert [await each.read() for each in silences] == [b"", b"", b""]  # until the server closes them
            writer.write(request(port))
            return await answered(reader)

    assert serving(speak) == (200, False)


def test_who_has_no_key_is_answered_once_and_nothing_more_is_read_of_it(serving):
    async def speak(_, port):
        async with connection(port) as (reader, writer):
            # Of the body nothing comes, nor has the server to wait for it.
            writer.write(request(port, "POST", "/session", "none", "Content-Length: 1000000\r\n"))
            assert await answered(reader) == (403, True)
            return await reader.read()

    assert serving(speak) == b""
