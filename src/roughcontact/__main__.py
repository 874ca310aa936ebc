"""``python -m roughcontact``, and the program ``roughcontact``: the command line."""

__all__ = ["run"]


def run() -> None:
    """Run the program; until it can answer Ctrl-C, that ends it at once."""
    from roughcontact.quiet_start import start_quietly

    start_quietly()
    from roughcontact.cli.main import run as program

    program()


if __name__ == "__main__":
    run()
