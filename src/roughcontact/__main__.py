"""``python -m roughcontact``: the command line."""

from roughcontact.cli.main import run

if __name__ == "__main__":
    run()
