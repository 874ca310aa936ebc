"""Threads that share the work of kernels: one leads, and others serve it while they wait for more.

Their shared state is an array of indices, a work queue of one entry. A kernel is offered while the sequence number is
odd. A thread reads that number again once it is counted among those inside, and the leader returns when no thread is.
"""

from __future__ import annotations

from roughcontact.kernels.code import Code
from roughcontact.kernels.signature import Indices, kernel
from roughcontact.kernels.team import (
    COUNTERS,
    HAS_LEADER,
    INSIDE,
    JOINED,
    KERNEL,
    PACKED,
    SEQUENCE,
    SERVING,
    WANTED,
)
from roughcontact.kernels.values import Index


@kernel
def _lead(code: Code, box: Indices, kernel: Index, packed: Index, wanted: Index) -> None:
    """Run a kernel, by `wanted` threads if they serve no other call; return when all is done."""
    place, counters, alone = code.index, code.new_counters(), code.variable(code.index(1))
    with code.when(place(1) < wanted):
        alone.set(box.swap(place(HAS_LEADER), 1))
    together = alone.get().equals(0)
    with code.when(together):
        for at, value in ((KERNEL, kernel), (PACKED, packed), (COUNTERS, counters), (WANTED, wanted)):
            box[place(at)] = value
        box.swap(place(JOINED), 0)
        box.add(place(SEQUENCE), 1)
    code.run(kernel, packed, counters, place(0))
    with code.when(together):
        box.add(place(SEQUENCE), 1)
        for _ in code.repeated(lambda: place(0) < box.current(place(INSIDE))):
            code.pause()
        box.swap(place(HAS_LEADER), 0)


@kernel
def _serve(code: Code, box: Indices, spins: Index, sleeps: Index, sleep: Index, long: Index) -> None:
    """Join in what is offered; return after a number of spins and then of sleeps without a new offer."""
    place, patience = code.index, spins + sleeps
    last, idle = code.variable(place(0)), code.variable(place(0))
    box.add(place(SERVING), 1)
    for _ in code.repeated(lambda: idle.get() < patience):
        sequence = box.current(place(SEQUENCE))
        with code.when((sequence % 2).equals(1) & ~sequence.equals(last.get())):
            box.add(place(INSIDE), 1)
            with code.when(box.current(place(SEQUENCE)).equals(sequence)):
                thread = box.add(place(JOINED), 1) + 1
                with code.when(thread < box[place(WANTED)]):
                    code.run(box[place(KERNEL)], box[place(PACKED)], box[place(COUNTERS)], thread)
                    idle.set(place(0))
            box.add(place(INSIDE), -1)
            last.set(sequence)
        idle.set(idle.get() + 1)
        with code.when(spins < idle.get()):
            code.call_system(sleep, long)
        code.pause()
    box.add(place(SERVING), -1)
