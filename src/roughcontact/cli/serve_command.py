"""The command ``serve``: a page in the browser, on this machine only."""

from __future__ import annotations

import threading
import webbrowser
from pathlib import Path

import typer

from roughcontact.cli.messages import UsageError, remark, reported
from roughcontact.cli.option_groups import argument, option
from roughcontact.recipe.texts import whole

__all__ = ["EXAMPLES", "serve"]

EXAMPLES = {
    "serve": """
roughcontact serve
roughcontact serve part.x3p
roughcontact serve part.x3p --port 8765 --no-browser
"""
}


def serve(
    file: Path | None = argument("Measured heights to begin with.", "[FILE]", None),
    *,
    port: int | None = option(
        "Port of this machine (default: a free one).", "8765", read=whole(1024, "a port", 65535)
    ),
    browser: bool = option("Whether to open a browser.", None, "--browser/--no-browser", default=True),
) -> None:
    """Open a page on this machine: drop a file, move the load, see the contact; every number also as a command."""
    with reported(file):
        try:
            from roughcontact.files.read import channels
            from roughcontact.page.server.serve import serve as run
        except ImportError as error:
            if (error.name or "").partition(".")[0] not in ("starlette", "uvicorn", "anyio", "h11"):
                raise
            raise UsageError(
                "the page needs Starlette and uvicorn", "pip install 'roughcontact[page]'"
            ) from error
        if file is not None and not file.is_file():
            raise UsageError(f"{file}: there is no such file")
        if file is not None:
            channels(file)  # an unreadable file raises before the page opens

        def opened(address: str, once: str) -> None:
            typer.echo(address)
            remark("only a user of this machine who has this address can open the page; Ctrl-C ends it")
            if browser:
                # In a thread: a browser that runs in the terminal returns only when it is closed.
                threading.Thread(target=webbrowser.open, args=(once,), daemon=True).start()

        try:
            run(file, port or 0, opened)
        except KeyboardInterrupt:
            remark("the page has ended and its files are removed")
        except OSError as error:
            raise UsageError(
                f"port {port} is not available ({error.strerror})", "leave it out", place="--port"
            ) from error
