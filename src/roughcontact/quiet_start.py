"""Ctrl-C in the first moments of the program."""

import signal

__all__ = ["start_quietly"]


def start_quietly() -> None:
    """Make Ctrl-C end the process at once, without a traceback of imports, until the program handles it."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
