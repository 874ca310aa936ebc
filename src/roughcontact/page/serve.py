"""The server of the page, on this machine alone."""

from __future__ import annotations

import asyncio
import contextlib
import os
import secrets
import signal
import socket
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import uvicorn

from roughcontact.page.guard import Guard
from roughcontact.page.page_app import PageServer, application
from roughcontact.page.workbench import UploadedFile

__all__ = ["serve"]

_LOOPBACK = "127.0.0.1"
_MOMENT = 0.1  # seconds between two looks at whether the server is to end


def serve(file: Path | None, port: int, opened: Callable[[str, str], None]) -> None:
    """Serve the page until the program is interrupted.

    Parameters
    ----------
    file : Path or None
        What the page shows first. No other file of the disk can be reached through it.
    port : int
        0 for any that is free.
    opened : callable
        Is told two addresses when the page can be asked for: one that holds the token, for the user, and one that opens
        the page once, for the command of a browser.

    Raises
    ------
    OSError
        If the port is taken.
    """
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as listening:
        if os.name == "posix":  # elsewhere it would let two servers have one port
            listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listening.bind((_LOOPBACK, port))
        guard = Guard(listening.getsockname()[1], secrets.token_urlsafe(24), secrets.token_urlsafe(24))
        given = None if file is None else UploadedFile(file.resolve(), str(file))
        with tempfile.TemporaryDirectory(prefix="roughcontact-page-", ignore_cleanup_errors=True) as folder:
            server = PageServer.of(guard, Path(folder), given)
            settings = uvicorn.Config(
                application(server),
                # What is installed beside them changes nothing.
                http="h11",
                ws="none",
                lifespan="on",
                proxy_headers=False,
                server_header=False,
                access_log=False,  # addresses hold keys
                log_level="error",
                timeout_graceful_shutdown=1,
            )
            listening.listen(64)
            opened(
                *(f"http://{_LOOPBACK}:{guard.port}/?token={token}" for token in (guard.token, guard.once))
            )
            with _closed_terminal_ends():
                asyncio.run(_run(uvicorn.Server(settings), server, listening))


async def _run(web: uvicorn.Server, page: PageServer, listening: socket.socket) -> None:
    """Serve until a signal ends it, and break off what is being answered."""
    serving = asyncio.create_task(web.serve(sockets=[listening]))
    while not (web.should_exit or serving.done()):
        await asyncio.wait({serving}, timeout=_MOMENT)
    page.closing.set()
    await serving


@contextlib.contextmanager
def _closed_terminal_ends() -> Iterator[None]:
    """Have the signal of a terminal that is closed end the program as SIGTERM does, and not leave files behind."""
    hangup = getattr(signal, "SIGHUP", None)  # Windows has none
    if hangup is None or signal.getsignal(hangup) is not signal.SIG_DFL:
        yield
        return
    signal.signal(hangup, lambda *_: signal.raise_signal(signal.SIGTERM))
    try:
        yield
    finally:
        signal.signal(hangup, signal.SIG_DFL)
