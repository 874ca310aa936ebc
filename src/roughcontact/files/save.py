"""Write a surface or a loaded state, in the format that the extension asks for."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np

from roughcontact.contact.solution import Solution
from roughcontact.files.aside import WriteError, written_aside
from roughcontact.files.vti import vti_bytes
from roughcontact.files.write_x3p import x3p_bytes
from roughcontact.surface.surface import Surface

__all__ = ["write"]


def write(what: Surface | Solution, path: str | os.PathLike[str]) -> None:
    """Write a surface or a solution; the file appears whole or not at all.

    ========  ==================================================================================================
    ``.npz``  a surface: heights, spacing, unit, periodic, history; read back to the last bit
    ``.nc``   a surface or a solution, NetCDF-4; the surface in it is read back to the last bit
    ``.x3p``  a surface, ISO 25178-72 in double precision; read back to the last bit, but for ``periodic`` and the
              history, for which the format has no place
    ``.vti``  a surface or the fields of a solution for ParaView; y points up, as its pictures do
    ========  ==================================================================================================

    Parameters
    ----------
    what : Surface or Solution
    path : str or path
        File to write; one that is there is replaced.

    Raises
    ------
    WriteError
        If the extension is none of these or not one for this value, or if the file cannot be written.
    """
    kind = Path(path).suffix.casefold()
    writers: dict[str, Callable[[Path], None]]
    if isinstance(what, Surface):
        writers = {
            ".npz": lambda aside: _npz(what, aside),
            ".nc": lambda aside: _netcdf(what, aside),
            ".x3p": lambda aside: _bytes(x3p_bytes(what), aside),
            ".vti": lambda aside: _bytes(vti_bytes({"heights": what.heights}, what.grid), aside),
        }
    elif isinstance(what, Solution):
        writers = {
            ".nc": lambda aside: _solution(what, aside),
            ".vti": lambda aside: _bytes(vti_bytes(_fields(what), what.problem.grid), aside),
        }
    else:
        raise WriteError(f"cannot write a {type(what).__name__}; give a Surface or a Solution")
    if kind not in writers:
        hint = "; write solution.problem.surface for its heights alone" if isinstance(what, Solution) else ""
        raise WriteError(
            f"cannot write {path}: a {type(what).__name__} is written as one of {', '.join(writers)}{hint}"
        )
    with written_aside(path) as aside:
        writers[kind](aside)


def _bytes(content: bytes, aside: Path) -> None:
    aside.write_bytes(content)


def _npz(surface: Surface, aside: Path) -> None:
    grid = surface.grid
    with open(aside, "wb") as stream:  # a stream, since a path would be given an extension
        np.savez_compressed(
            stream,
            heights=surface.heights,
            spacing=np.array(grid.spacing),
            unit=np.array("m"),
            periodic=np.array(grid.periodic),
            history=np.array(surface.provenance, dtype=np.str_),
        )


def _netcdf(surface: Surface, aside: Path) -> None:
    import xarray

    from roughcontact.contact.variables import VARIABLES
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_netcdf

    grid = surface.grid
    axes = ("y", "x")[-grid.ndim :]

    def variable(name: str, dimensions: tuple[str, ...], values: object) -> tuple[object, ...]:
        known = VARIABLES[name]
        attributes = {"long_name": known.long_name} | ({"units": known.unit} if known.unit else {})
        return dimensions, np.asarray(values), attributes

    scales = {"lengths": grid.lengths, "spacing": grid.spacing, "periodic": grid.periodic}
    data = {name: variable(name, ("axis",), values) for name, values in scales.items()}
    data["heights"] = variable("heights", axes, surface.heights)
    places = {
        axis: variable(axis, (axis,), (np.arange(n) + 0.5) * step)
        for axis, n, step in zip(axes, grid.shape, grid.spacing, strict=True)
    }
    dataset = xarray.Dataset(
        data,
        places | {"axis": ("axis", list(axes))},
        {"Conventions": "CF-1.11", "title": "heights of a surface"},
    )
    write_netcdf(dataset, aside, provenance(surface))


def _solution(solution: Solution, aside: Path) -> None:
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_netcdf

    problem = solution.problem
    write_netcdf(solution.to_dataset(), aside, provenance(problem.surface, modulus=problem.modulus))


def _fields(solution: Solution) -> dict[str, np.typing.NDArray[np.generic]]:
    surface = solution.problem.surface
    heights = {} if surface is None else {"heights": surface.heights}
    return heights | {
        "pressure": solution.pressure,
        "displacement": solution.displacement,
        "gap": solution.gap,
        "contact": solution.contact,
    }
