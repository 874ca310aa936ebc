"""What one surface in slabs takes: time, memory of each process, and what goes from one to another.

mpiexec -n 4 python -m mpi4py benchmarks/slabs.py [CELLS_ALONG_A_SIDE] [curve]
python benchmarks/slabs.py [CELLS_ALONG_A_SIDE] [curve] whole

Waves down from a quarter of the side, one load or a curve of five up to it: the least time of three, and in one more
run the memory. That is of fields as Python counts it, without the interpreter, in bytes for each cell of a process's
share, and so is what a process sends. `whole` is one process without slabs.
"""

import sys
import time
import tracemalloc

import numpy as np
from mpi4py import MPI

import roughcontact as rc

ROUNDS = 3


class Counting:
    """A communicator that counts what it sends in exchanges."""

    def __init__(self, communicator):
        self._communicator, self.sent = communicator, 0

    def __getattr__(self, name):
        return getattr(self._communicator, name)

    def Alltoallv(self, sendbuf, recvbuf):  # noqa: D102
        numbers, counts = sendbuf
        self.sent += (sum(counts) - counts[self.rank]) * numbers.itemsize
        self._communicator.Alltoallv(sendbuf, recvbuf)


def load(surface):
    solution = rc.press(surface, 1e9, pressure=5e5)
    return solution.contact_fraction, f"{solution.steps} products, "


def load_curve(surface):
    return rc.loading_curve(surface, 1e9, pressures=np.geomspace(5e4, 5e5, 5)).contact_fraction[-1], ""


def main(cells, curve, whole):
    world = Counting(MPI.COMM_WORLD)
    slabs = rc.Slabs(world)
    grid = rc.Grid((cells, cells), 1e-6, periodic=True)
    rng, share = np.random.default_rng(1), grid.size / world.size
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rolloff=cells * 1e-6 / 4, rng=rng, slabs=slabs)
    if whole:
        surface = rc.Surface(surface.heights.gathered(), grid)
    work, seconds = load_curve if curve else load, []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        work(surface)
        seconds.append(time.perf_counter() - start)
    world.sent = 0
    tracemalloc.start()
    contact, products = work(surface)
    held = 8 + tracemalloc.get_traced_memory()[1] / share
    sent = world.sent / share
    everyone = world.gather((held, sent))
    light, full = (8 + needed / share for needed in rc.memory_needed(surface, curve=curve))
    if world.rank == 0:
        print(f"{cells} x {cells} cells, {contact:.1%} in contact: {products}{min(seconds):.2f} s")
        print(f"memory_needed: {light:.0f} to {full:.0f} bytes a cell")
        for rank, (bytes_held, bytes_sent) in enumerate(everyone):
            print(f"process {rank} of {world.size}: {bytes_held:.0f} bytes a cell, sent {bytes_sent:.0f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1024, "curve" in sys.argv, "whole" in sys.argv)
