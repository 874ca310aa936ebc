"""The program as a launcher starts it, with a fault of the last process: python program.py FAULT ARGUMENTS."""

import os
import signal
import sys

import roughcontact as rc
from roughcontact.cli.job import launched
from roughcontact.cli.main import run

fault = sys.argv.pop(1)
rank, size = launched()
real = rc.press


def press(*arguments, **keywords):
    if fault == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    raise MemoryError


if fault != "none" and rank == size - 1:
    rc.press = press
run()
