"""``python -m roughcontact``, and the program ``roughcontact``: the command line."""

import signal

__all__ = ["run"]


def run() -> None:
    """Run the program; until it can answer Ctrl-C, that ends it at once, without Python's traceback of imports."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    from roughcontact.cli.main import run as program

    program()


if __name__ == "__main__":
    run()
