"""Whether an error is for the user to mend, or a mistake of this program."""

from __future__ import annotations

from opcode import opmap
from types import TracebackType

__all__ = ["PACKAGE", "is_ours", "raised_in"]

_RAISE = opmap["RAISE_VARARGS"]
PACKAGE = "roughcontact"


def is_ours(error: ValueError | OSError) -> bool:
    """Return whether `error` speaks to the user: a file's trouble, or an error that our own code raises.

    A ValueError of NumPy or another library, raised inside a call of ours, is a mistake of ours and no
    bad input. One that comes out of compiled code has our line as its last frame, too, so what counts is
    whether that line is a ``raise``.
    """
    if isinstance(error, BrokenPipeError):
        return False  # whoever read our output has gone; typer knows how to leave quietly
    if isinstance(error, OSError) and error.filename is not None:
        return True
    last, package = raised_in(error)
    return last is not None and package == PACKAGE and last.tb_frame.f_code.co_code[last.tb_lasti] == _RAISE


def raised_in(error: BaseException) -> tuple[TracebackType | None, str]:
    """Return where an error was raised, and the package of that place by its name; None and "" of one that was not.

    By its name and not its file, which bundles of programs do not have. A package whose name begins with
    ``roughcontact_`` adds commands to the program, and counts as this one.
    """
    last = error.__traceback__
    while last is not None and last.tb_next is not None:
        last = last.tb_next
    name = "" if last is None else str(last.tb_frame.f_globals.get("__name__")).partition(".")[0]
    return last, PACKAGE if name.startswith(f"{PACKAGE}_") else name
