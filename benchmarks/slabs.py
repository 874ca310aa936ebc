"""What one surface in slabs takes: memory of each process, and what goes from one to another.

mpiexec -n 4 python -m mpi4py benchmarks/slabs.py [CELLS_ALONG_A_SIDE]

Waves down from a quarter of the side. Memory is that of fields as Python counts it, without the
interpreter; it is counted in bytes for each cell of a process's share, and so is what it sends.
"""

import sys
import tracemalloc

import numpy as np
from mpi4py import MPI

import roughcontact as rc


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


def main(cells):
    world = Counting(MPI.COMM_WORLD)
    slabs = rc.Slabs(world)
    grid = rc.Grid((cells, cells), 1e-6, periodic=True)
    rng, share = np.random.default_rng(1), grid.size / world.size
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rolloff=cells * 1e-6 / 4, rng=rng, slabs=slabs)
    world.sent = 0  # to make it
    tracemalloc.start()
    solution = rc.press(surface, 1e9, pressure=5e5)
    held = 8 + tracemalloc.get_traced_memory()[1] / share
    sent = world.sent / share
    everyone = world.gather((held, sent))
    contact = solution.contact_fraction
    if world.rank == 0:
        print(f"{cells} x {cells} cells, {contact:.1%} in contact, {solution.steps} products")
        for rank, (bytes_held, bytes_sent) in enumerate(everyone):
            print(f"process {rank} of {world.size}: {bytes_held:.0f} bytes a cell, sent {bytes_sent:.0f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1024)
