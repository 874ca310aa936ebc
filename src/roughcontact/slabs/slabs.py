"""The processes that hold a plane by rows."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.slabs.array_functions import SlabFunctions
from roughcontact.slabs.communicator import Communicator
from roughcontact.slabs.one_process import OneProcess
from roughcontact.slabs.rows import edges_of
from roughcontact.slabs.slab_array import SlabArray

__all__ = ["Slabs"]

NEEDED = ("rank", "size", "allgather", "sendrecv", "Allgatherv", "Alltoallv")


class Slabs:
    """The processes that hold one periodic surface together, some rows each, and press it together.

    Parameters
    ----------
    communicator : mpi4py.MPI.Comm, optional
        The processes; without it, only this one.

    Attributes
    ----------
    communicator : mpi4py.MPI.Comm
        The processes.
    functions : SlabFunctions
        The array library of what they hold together.

    Raises
    ------
    ValueError
        If this is no communicator.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> slabs = rc.Slabs()  # with mpi4py: rc.Slabs(MPI.COMM_WORLD)
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> heights = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1)).heights
    >>> mine = slabs.array(heights[slabs.rows(64)])  # each process needs these rows alone
    >>> solution = rc.press(rc.Surface(mine, grid), 1e9, pressure=1e6)
    >>> solution.status.value, solution.pressure.local.shape, solution.pressure.gathered().shape
    ('converged', (64, 64), (64, 64))
    """

    __slots__ = ("communicator", "functions")

    def __init__(self, communicator: Communicator | None = None) -> None:
        self.communicator: Communicator = OneProcess() if communicator is None else communicator
        lacking = [name for name in NEEDED if not hasattr(self.communicator, name)]
        if lacking:
            raise InputError(
                f"a communicator is wanted, such as mpi4py.MPI.COMM_WORLD, not {communicator!r}, which lacks "
                f"{', '.join(lacking)}",
                place="communicator",
            )
        self.functions = SlabFunctions(self.communicator)

    def rows(self, count: int) -> slice:
        """Return which rows this process holds, of a plane of `count` rows.

        Parameters
        ----------
        count : int
            Rows of the whole.

        Returns
        -------
        slice
        """
        edges, rank = edges_of(count, self.communicator.size), self.communicator.rank
        return slice(edges[rank], edges[rank + 1])

    def array(self, local: npt.ArrayLike) -> SlabArray:
        """Return an array of which each process gives its rows; all of them do so together.

        Parameters
        ----------
        local : array
            Those of ``rows``, which are copied.

        Returns
        -------
        SlabArray
            Its ``local`` are the rows of this process, its ``gathered()`` the whole on every one.

        Raises
        ------
        ValueError
            If the rows are not those of ``rows``, or differ in length or type.
        """
        own = np.array(local, order="C")
        given = self.communicator.allgather((own.shape, own.dtype))
        if len({(shape[1:], dtype) for shape, dtype in given}) != 1:
            raise InputError(f"the processes gave rows that differ in length or type: {given}")
        counts = [shape[0] for shape, _ in given]
        edges = edges_of(sum(counts), self.communicator.size)
        if counts != [end - start for start, end in pairwise(edges)]:
            raise InputError(
                f"the processes gave {counts} rows; those of process {self.communicator.rank} of a plane of "
                f"{edges[-1]} are {self.rows(edges[-1])}",
                "give the rows of Slabs.rows",
            )
        return SlabArray(own, edges, self.functions)
