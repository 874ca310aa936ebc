"""Start and end of the program, with its exit status."""

from __future__ import annotations

import errno
import io
import os
import signal
import sys
import traceback
from typing import NoReturn

from roughcontact.cli.exits import BAD_INPUT, INTERRUPTED, MISTAKE, TERMINATED
from roughcontact.cli.job import as_one, refusal
from roughcontact.cli.json_answer import emit_error
from roughcontact.files.installed import broken_package

__all__ = ["run"]

_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EIO)


def run() -> None:
    """Run the program, in all processes that a launcher of MPI jobs has started."""
    with as_one():
        _run()


def _run() -> None:
    try:
        signal.signal(signal.SIGTERM, _terminate)
        if signal.getsignal(signal.SIGINT) is signal.SIG_DFL:  # as set while this file was imported
            signal.signal(signal.SIGINT, signal.default_int_handler)
        for stream in (sys.stdout, sys.stderr):
            # A terminal or pipe that cannot show a letter gets a question mark, not a crash.
            if isinstance(stream, io.TextIOWrapper):
                stream.reconfigure(errors="replace")
        # Late: the import takes a second, and Ctrl-C during it must not end in a traceback.
        from roughcontact.cli.app import app

        if (problem := refusal(sys.argv[1:])) is not None:
            sys.stderr.write(f"Error: {problem}\n")
            if _as_json():
                emit_error("usage", problem.message, BAD_INPUT, problem.remedy)
            sys.exit(BAD_INPUT)
        app(prog_name="roughcontact")
    except KeyboardInterrupt:
        sys.stderr.write("Interrupted.\n")
        if _as_json():
            emit_error("interrupted", "Interrupted.", INTERRUPTED)
        sys.exit(INTERRUPTED)
    except Exception as error:
        # Errors of files are reported before they come here: this is an error of standard output.
        if isinstance(error, OSError) and error.filename is None and error.errno in _NO_ROOM:
            sys.stderr.write(f"Error: the output cannot be written: {error.strerror}\n")
            sys.exit(BAD_INPUT)
        if (broken := broken_package(error)) is not None:
            sys.stderr.write(f"Error: {broken}\n")
            if _as_json():
                emit_error("installation", broken.message, BAD_INPUT, broken.remedy)
            sys.exit(BAD_INPUT)
        traceback.print_exc()
        sys.stderr.write("This is a mistake in roughcontact, not in your input: please report these lines.\n")
        if _as_json():
            emit_error(
                "mistake", f"{type(error).__name__}: {error}", MISTAKE, "report the lines on standard error"
            )
        sys.exit(MISTAKE)
    finally:
        _let_go_of_output()


def _as_json() -> bool:
    return "--json" in sys.argv[1:]


def _terminate(*_: object) -> NoReturn:
    # An exception, so that every half-written file is removed.
    raise SystemExit(TERMINATED)


def _let_go_of_output() -> None:
    """Flush standard output; if it is closed, drop its contents."""
    try:
        sys.stdout.flush()
    except OSError:
        # Otherwise Python would try again at exit, and print an error.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
