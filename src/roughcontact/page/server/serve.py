"""The server of the page, on this machine only."""

from __future__ import annotations

import asyncio
import contextlib
import os
import secrets
import signal
import socket
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import uvicorn
from starlette.types import ASGIApp
from uvicorn.protocols.http.h11_impl import H11Protocol

from roughcontact.page.jobs.session_cache import UploadedFile
from roughcontact.page.server.guard import Guard
from roughcontact.page.server.page_app import PageServer, application
from roughcontact.page.server.server_folder import server_folder
from roughcontact.page.server.workers import Sessions

__all__ = ["serve"]

_LOOPBACK = "127.0.0.1"
_MOMENT = 0.1  # seconds between two checks whether the server must end
_SILENT = 5.0  # seconds in which a new connection must bring a request


def serve(file: Path | None, port: int, opened: Callable[[str, str], None]) -> None:
    """Serve the page until the program is interrupted.

    Parameters
    ----------
    file : Path or None
        The first file on the page. The page cannot reach other files of the disk.
    port : int
        0 for any free port.
    opened : callable
        Called with two addresses when the page is available: one with the token, for the user, and one that opens the
        page once, for the command of a browser.

    Raises
    ------
    OSError
        If the port is taken.
    """
    with _bound(port) as listening, server_folder() as folder:
        guard = Guard(listening.getsockname()[1], secrets.token_urlsafe(24), secrets.token_urlsafe(24))
        given = None if file is None else UploadedFile(file.resolve(), str(file))
        server = PageServer(guard, Sessions(folder, given))
        listening.listen(64)
        opened(*(f"http://{_LOOPBACK}:{guard.port}/?token={token}" for token in (guard.token, guard.once)))
        with _closed_terminal_ends():
            asyncio.run(_run(_web(application(server)), server, listening))


def _bound(port: int) -> socket.socket:
    """Return a socket for connections from this machine only, which send data without delay."""
    # asyncio sets TCP_NODELAY on sockets that name their protocol: otherwise each answer waits for an acknowledgement.
    bound = socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    try:
        if os.name == "posix":  # elsewhere it would allow two servers on one port
            bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        bound.bind((_LOOPBACK, port))
    except OSError:
        bound.close()
        raise
    return bound


def _web(app: ASGIApp, silent: float = _SILENT) -> uvicorn.Server:
    """Return a server of an application; a connection that brings no request in time [s] is closed."""

    def connected(**given: Any) -> H11Protocol:
        connection = H11Protocol(**given)
        asyncio.get_running_loop().call_later(silent, _close_if_silent, connection)
        return connection

    settings = uvicorn.Config(
        app,
        # Other installed packages must not change these choices.
        http=connected,  # type: ignore[arg-type]  # called as the class would be
        ws="none",
        lifespan="on",
        proxy_headers=False,
        server_header=False,
        access_log=False,  # addresses contain keys
        log_level="error",
        timeout_graceful_shutdown=1,
    )
    return uvicorn.Server(settings)


def _close_if_silent(connection: H11Protocol) -> None:
    if not connection.cycle:  # no request has come; one without the key has closed it
        connection.transport.close()


async def _run(web: uvicorn.Server, page: PageServer, listening: socket.socket) -> None:
    """Serve until a signal ends it, and break off unfinished answers."""
    serving = asyncio.create_task(web.serve(sockets=[listening]))
    while not (web.should_exit or serving.done()):
        await asyncio.wait({serving}, timeout=_MOMENT)
    page.closing.set()
    await serving


@contextlib.contextmanager
def _closed_terminal_ends() -> Iterator[None]:
    """Make a closed terminal end the program as SIGTERM does, which removes its files."""
    hangup = getattr(signal, "SIGHUP", None)  # Windows has none
    if hangup is None or signal.getsignal(hangup) is not signal.SIG_DFL:
        yield
        return
    signal.signal(hangup, lambda *_: signal.raise_signal(signal.SIGTERM))
    try:
        yield
    finally:
        signal.signal(hangup, signal.SIG_DFL)
