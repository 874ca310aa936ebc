"""``python -m roughcontact``, and the program ``roughcontact``: the command line."""

__all__ = ["run"]


def run() -> None:
    """Run the program; Ctrl-C ends it at once until it handles Ctrl-C itself."""
    from roughcontact.quiet_start import start_quietly

    start_quietly()
    from roughcontact.cli.main import run as program

    program()


if __name__ == "__main__":
    run()
