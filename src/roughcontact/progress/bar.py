"""A bar of tqdm for notebooks and scripts."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from roughcontact.progress.events import Event, listening

__all__ = ["bar"]

_INTERVAL = 0.1  # seconds between two events of a task
_COUNTED = "{desc}: {percentage:3.0f}%|{bar}| {n:g} of {total:g} {unit} [{elapsed}<{remaining}]{postfix}"
_UNCOUNTED = "{desc}: {n:g} {unit} [{elapsed}]{postfix}"


@contextmanager
def bar(**options: object) -> Iterator[None]:
    """Show a bar of tqdm for each long task in this block: in a notebook as a widget, elsewhere on standard error.

    Bars of tasks that count nothing, or that are inside another task, vanish when they end.

    Parameters
    ----------
    **options
        Keywords of ``tqdm``, such as ``file`` or ``disable``.

    Yields
    ------
    None
        Bars are shown until the block ends.

    Raises
    ------
    ModuleNotFoundError
        If tqdm is not installed: ``pip install "roughcontact[notebook]"`` installs it.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> with rc.progress.bar(disable=True):  # without disable=True a bar is shown
    ...     curve = rc.loading_curve(ball, 1e9, forces=[1e-3, 4e-3])
    """
    try:
        from tqdm.auto import tqdm
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            'rc.progress.bar needs the package tqdm: run pip install "roughcontact[notebook]", or give '
            "rc.progress.listening your function",
            name=error.name,
        ) from error
    shown: dict[int, Any] = {}

    def show(event: Event) -> None:
        one = shown.get(event.number)
        if one is None:
            form = _UNCOUNTED if event.total is None else _COUNTED
            given = {
                "desc": event.task,
                "total": event.total,
                "unit": event.unit,
                "leave": not event.level and bool(event.unit),
            }
            one = shown[event.number] = tqdm(
                **{**given, "initial": event.done, "bar_format": form, **options}
            )
        one.n = event.done
        if event.note:
            one.set_postfix_str(event.note, refresh=False)
        one.refresh()
        if event.state in ("finished", "stopped"):
            shown.pop(event.number).close()

    try:
        with listening(show, interval=_INTERVAL):
            yield
    finally:
        for one in shown.values():  # the bars of generators that were left open
            one.close()
