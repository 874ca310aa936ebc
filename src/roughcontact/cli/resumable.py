"""What is said of a run that is stopped and can go on."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import typer

from roughcontact.cli.exits import INTERRUPTED, TERMINATED

__all__ = ["resumable"]


@contextmanager
def resumable(command: str) -> Iterator[None]:
    """Say how to go on where the run is stopped."""
    try:
        yield
    except KeyboardInterrupt:
        typer.echo(f"Stopped; every finished case is stored. To go on: {command}", err=True)
        raise typer.Exit(INTERRUPTED) from None
    except SystemExit as end:
        if end.code == TERMINATED:
            typer.echo(f"Every finished case is stored. To go on: {command}", err=True)
        raise
