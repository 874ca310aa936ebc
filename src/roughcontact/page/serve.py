"""The server of the page, on this machine alone."""

from __future__ import annotations

import secrets
import socket
import tempfile
from collections.abc import Callable
from pathlib import Path

import uvicorn

from roughcontact.page.guard import Guard
from roughcontact.page.page_app import PageServer, application
from roughcontact.page.workbench import UploadedFile

__all__ = ["serve"]

_LOOPBACK = "127.0.0.1"


def serve(file: Path | None, port: int, opened: Callable[[str], None]) -> None:
    """Serve the page until the program is interrupted.

    Parameters
    ----------
    file : Path or None
        What the page shows first. No other file of the disk can be reached through it.
    port : int
        0 for any that is free.
    opened : callable
        Is told the address, which holds the token, when the page can be asked for.

    Raises
    ------
    OSError
        If the port is taken.
    """
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as listening:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listening.bind((_LOOPBACK, port))
        guard = Guard(listening.getsockname()[1], secrets.token_urlsafe(24))
        given = None if file is None else UploadedFile(file.resolve(), str(file))
        with tempfile.TemporaryDirectory(prefix="roughcontact-page-", ignore_cleanup_errors=True) as folder:
            server = PageServer.of(guard, Path(folder), given)
            settings = uvicorn.Config(
                application(server),
                # What is installed beside them changes nothing.
                http="h11",
                loop="asyncio",
                ws="none",
                lifespan="on",
                proxy_headers=False,
                server_header=False,
                access_log=False,  # addresses hold keys
                log_level="error",
                timeout_graceful_shutdown=1,
            )
            listening.listen(64)
            opened(f"http://{_LOOPBACK}:{guard.port}/?token={guard.token}")
            uvicorn.Server(settings).run(sockets=[listening])
