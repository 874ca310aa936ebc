"""Processes of a communicator as threads of one, so that what runs on many is tested where there is no MPI."""

import threading
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from queue import Queue

import numpy as np

PATIENCE = 60  # seconds after which a call that the others do not make is an error, not a wait for ever


class Shared:
    """What the members see of each other."""

    def __init__(self, size):
        self.barrier = threading.Barrier(size, timeout=PATIENCE)
        self.given = [None] * size
        self.ways = {(a, b): Queue() for a in range(size) for b in range(size)}


class Member:
    """One of them; its methods are those of mpi4py's communicators."""

    def __init__(self, shared, rank):
        self._shared, self.rank, self.size = shared, rank, len(shared.given)

    def allgather(self, sendobj):
        self._shared.given[self.rank] = sendobj
        self._shared.barrier.wait()
        answer = list(self._shared.given)
        self._shared.barrier.wait()  # nobody gives anew before all have taken
        return answer

    def sendrecv(self, sendobj, dest, *, source):
        self._shared.ways[self.rank, dest].put(sendobj)  # the others need not take part
        return self._shared.ways[source, self.rank].get(timeout=PATIENCE)

    def Allgatherv(self, sendbuf, recvbuf):
        whole, counts = recvbuf
        parts = self.allgather(sendbuf.copy())
        assert [len(part) for part in parts] == list(counts)
        whole[...] = np.concatenate(parts)

    def Alltoallv(self, sendbuf, recvbuf):
        given, there = sendbuf
        taken, back = recvbuf
        ends = np.cumsum([0, *there])
        assert ends[-1] == given.size
        parts = [given.reshape(-1)[a:b].copy() for a, b in pairwise(ends)]
        mine = [parts[self.rank] for parts in self.allgather(parts)]
        assert [len(part) for part in mine] == list(back)
        taken.reshape(-1)[...] = np.concatenate(mine)


def together(size, work):
    """Return what `work` returns on each of so many members, which it is given."""
    shared = Shared(size)

    def one(rank):
        try:
            return work(Member(shared, rank))
        except BaseException:
            shared.barrier.abort()  # the others are not to wait
            raise

    with ThreadPoolExecutor(size) as pool:
        work_of_each = [pool.submit(one, rank) for rank in range(size)]
    errors = [each.exception() for each in work_of_each]
    for error in sorted(
        filter(None, errors), key=lambda error: isinstance(error, threading.BrokenBarrierError)
    ):
        raise error  # what broke the barrier before what it broke
    return [each.result() for each in work_of_each]
