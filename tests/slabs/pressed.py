"""What tests run on each process of a job: mpiexec -n N python -m mpi4py pressed.py HEIGHTS ANSWERS [FAULT]."""

import os
import signal
import sys

import numpy as np
from mpi4py import MPI

import roughcontact as rc


def main(heights, answers, fault=""):
    world = MPI.COMM_WORLD
    slabs = rc.Slabs(world)
    whole = np.load(heights, mmap_mode="r")
    grid = rc.Grid(whole.shape, 1e-6, periodic=True)
    mine = slabs.array(whole[slabs.rows(len(whole))])
    if fault and world.rank == 1:
        if fault == "killed":
            os.kill(os.getpid(), signal.SIGKILL)
        raise RuntimeError("this process has failed")
    solution = rc.press(rc.Surface(mine, grid), 1e9, pressure=1e6, tolerance=1e-12)
    numbers = [solution.depth, solution.force, solution.stiffness, solution.residual]
    everyone = world.gather(numbers, root=0)
    pressure = solution.pressure.gathered()
    if world.rank == 0:
        np.savez(answers, pressure=pressure, numbers=everyone)


if __name__ == "__main__":
    main(*sys.argv[1:])
