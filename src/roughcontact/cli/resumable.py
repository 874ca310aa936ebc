"""Messages about a run that is stopped and can be resumed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import typer

from roughcontact.cli.exits import INTERRUPTED, TERMINATED
from roughcontact.cli.messages import ended

__all__ = ["resumable"]


@contextmanager
def resumable(command: str, *, as_json: bool = False) -> Iterator[None]:
    """Print how to resume a run that is stopped."""
    try:
        yield
    except KeyboardInterrupt:
        ended(
            "interrupted",
            "Stopped; every finished case is stored.",
            INTERRUPTED,
            as_json=as_json,
            remedy=command,
        )
        raise typer.Exit(INTERRUPTED) from None
    except SystemExit as end:
        if end.code != TERMINATED:
            raise
        ended(
            "terminated",
            "Every finished case is stored.",
            TERMINATED,
            as_json=as_json,
            remedy=command,
        )
        raise typer.Exit(TERMINATED) from None
