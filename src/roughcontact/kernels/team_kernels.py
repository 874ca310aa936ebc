"""Threads that share the work of kernels: one leads, and others serve it while they wait for more.

What they know of each other is a box of indices. A kernel is offered in it while its ticket is odd; whoever comes looks
at the ticket again once he is counted among those inside, and the leader goes on when nobody is inside any more.
"""

from __future__ import annotations

from roughcontact.kernels.code import Code
from roughcontact.kernels.signature import Indices, kernel
from roughcontact.kernels.team import (
    COUNTERS,
    INSIDE,
    JOINED,
    KERNEL,
    LED,
    PACKED,
    SERVING,
    TICKET,
    WANTED,
)
from roughcontact.kernels.values import Index


@kernel
def _lead(code: Code, box: Indices, kernel: Index, packed: Index, wanted: Index) -> None:
    """Run a kernel, by so many threads if they serve and serve nobody else; return when all is done."""
    place, counters, alone = code.index, code.new_counters(), code.variable(code.index(1))
    with code.when(place(1) < wanted):
        alone.set(box.swap(place(LED), 1))
    together = alone.get().equals(0)
    with code.when(together):
        for at, value in ((KERNEL, kernel), (PACKED, packed), (COUNTERS, counters), (WANTED, wanted)):
            box[place(at)] = value
        box.swap(place(JOINED), 0)
        box.add(place(TICKET), 1)
    code.run(kernel, packed, counters, place(0))
    with code.when(together):
        box.add(place(TICKET), 1)
        for _ in code.repeated(lambda: place(0) < box.current(place(INSIDE))):
            code.pause()
        box.swap(place(LED), 0)


@kernel
def _serve(code: Code, box: Indices, pauses: Index, naps: Index, sleep: Index, long: Index) -> None:
    """Join in what is offered, until nothing new was for so many pauses, and naps of some length after them."""
    place, patience = code.index, pauses + naps
    seen, idle = code.variable(place(0)), code.variable(place(0))
    box.add(place(SERVING), 1)
    for _ in code.repeated(lambda: idle.get() < patience):
        ticket = box.current(place(TICKET))
        with code.when((ticket % 2).equals(1) & ~ticket.equals(seen.get())):
            box.add(place(INSIDE), 1)
            with code.when(box.current(place(TICKET)).equals(ticket)):
                thread = box.add(place(JOINED), 1) + 1
                with code.when(thread < box[place(WANTED)]):
                    code.run(box[place(KERNEL)], box[place(PACKED)], box[place(COUNTERS)], thread)
                    idle.set(place(0))
            box.add(place(INSIDE), -1)
            seen.set(ticket)
        idle.set(idle.get() + 1)
        with code.when(pauses < idle.get()):
            code.call_system(sleep, long)
        code.pause()
    box.add(place(SERVING), -1)
