"""Write a surface or a loaded state, in the format that the extension asks for."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import MappingProxyType

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import on_host
from roughcontact.contact.curve import Curve
from roughcontact.contact.solution import Solution
from roughcontact.files.aside import WriteError, require_target, written_aside
from roughcontact.files.vti import vti_bytes
from roughcontact.files.write import write_csv, write_netcdf
from roughcontact.files.write_text import text_of
from roughcontact.files.write_x3p import x3p_bytes
from roughcontact.friction.slip_curve import SlipCurve
from roughcontact.friction.slip_solution import TangentialSolution
from roughcontact.surface.surface import Surface

__all__ = ["require_surface_file", "write"]

Field = npt.NDArray[np.generic]
# Components by their place, name and sign in a picture whose rows are turned up.
_UPRIGHT = ((0, "x", 1.0), (1, "y", -1.0))
Writable = Surface | Solution | TangentialSolution | Curve | SlipCurve


def write(what: Writable, path: str | os.PathLike[str]) -> None:
    """Write a surface, a solution or a curve; the file appears whole or not at all.

    ========  ==================================================================================================
    ``.npz``  a surface: heights, spacing, unit, periodic, history; read back to the last bit
    ``.nc``   a surface, a solution or a curve, NetCDF-4; the surface in it is read back to the last bit, a loading
              curve by `read_curve`
    ``.csv``  a curve: one line a load
    ``.x3p``  a surface, ISO 25178-72 in double precision; read back to the last bit, but for ``periodic`` and the
              history, for which the format has no place
    ``.txt``  a surface: rows of heights under the header that Gwyddion writes, a line as places and heights;
              read back but for ``periodic`` and the history, the spacing to rounding
    ``.npy``  the heights of a surface [m] and nothing else: unit and size are to be stated when it is read
    ``.vti``  a surface or the fields of a solution for ParaView; y points up, as its pictures do
    ========  ==================================================================================================

    Parameters
    ----------
    what : Surface, Solution, TangentialSolution, Curve or SlipCurve
        What is written.
    path : str or path
        File to write; one that is there is replaced.

    Raises
    ------
    WriteError
        If the extension is not in the table or not for this value, or if the file cannot be written.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> rc.write(ball, "ball.npz")
    >>> rc.read("ball.npz").grid == ball.grid
    True
    """
    if isinstance(what, Surface):
        require_surface_file(path)
        with written_aside(path) as aside:
            _OF_A_SURFACE[_kind(path)](what, aside)
    elif isinstance(what, Solution | TangentialSolution):
        hint = "; write solution.problem.surface for its heights alone" if isinstance(what, Solution) else ""
        _require_kind(path, type(what).__name__, _OF_A_SOLUTION, hint)
        with written_aside(path) as aside:
            _OF_A_SOLUTION[_kind(path)](what, aside)
    elif isinstance(what, Curve | SlipCurve):
        _require_kind(path, type(what).__name__, _OF_A_CURVE)
        _OF_A_CURVE[_kind(path)](what.to_dataset(), path)
    else:
        raise WriteError(f"cannot write a {type(what).__name__}; give a Surface, a solution or a curve")


def require_surface_file(path: str | os.PathLike[str]) -> None:
    """Refuse, before any work is done, a file that `write` could not write a surface to.

    Raises
    ------
    WriteError
        If its extension is not known, or there is no such folder, no permission, a folder of that name.
    """
    _require_kind(path, "Surface", _OF_A_SURFACE)
    require_target(path)


def _require_kind(path: str | os.PathLike[str], what: str, known: Iterable[str], hint: str = "") -> None:
    if _kind(path) not in known:
        raise WriteError(f"cannot write {path}: a {what} is written as one of {', '.join(known)}{hint}")


def _kind(path: str | os.PathLike[str]) -> str:
    return Path(path).suffix.casefold()


def _x3p(surface: Surface, aside: Path) -> None:
    aside.write_bytes(x3p_bytes(surface))


def _vti(surface: Surface, aside: Path) -> None:
    aside.write_bytes(vti_bytes({"heights": surface.heights}, surface.grid))


def _text(surface: Surface, aside: Path) -> None:
    aside.write_text(text_of(surface), encoding="utf-8", newline="\n")


def _npy(surface: Surface, aside: Path) -> None:
    with open(aside, "wb") as stream:  # a stream, since a path would be given an extension
        np.save(stream, surface.heights)


def _npz(surface: Surface, aside: Path) -> None:
    grid = surface.grid
    with open(aside, "wb") as stream:
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

    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_netcdf
    from roughcontact.labels.variables import VARIABLES

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


def _solution(solution: Solution | TangentialSolution, aside: Path) -> None:
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_netcdf

    problem = _pressed(solution).problem
    write_netcdf(solution.to_dataset(), aside, provenance(problem.surface, modulus=problem.modulus))


def _solution_vti(solution: Solution | TangentialSolution, aside: Path) -> None:
    fields = _fields(_pressed(solution))
    if isinstance(solution, TangentialSolution):
        fields |= _tangential_fields(solution)
    aside.write_bytes(vti_bytes(fields, _pressed(solution).problem.grid))


def _pressed(solution: Solution | TangentialSolution) -> Solution:
    """Return the state under the normal force alone."""
    return solution.problem.pressed if isinstance(solution, TangentialSolution) else solution


def _fields(solution: Solution) -> dict[str, Field]:
    surface = solution.problem.surface
    heights = {} if surface is None else {"heights": surface.heights}
    return heights | {
        "pressure": solution.pressure,
        "displacement": solution.displacement,
        "gap": solution.gap,
        "contact": solution.contact,
    }


def _tangential_fields(solution: TangentialSolution) -> dict[str, Field]:
    """Return components by name; with the picture, which is turned up, those along y change their sign."""
    vectors = {"traction": on_host(solution.traction), "slip": on_host(solution.slip)}
    parts = {
        f"{name}_{axis}": sign * field[at] for name, field in vectors.items() for at, axis, sign in _UPRIGHT
    }
    return parts | {"slipping": on_host(solution.slipping).astype(bool)}


_OF_A_SURFACE: Mapping[str, Callable[[Surface, Path], None]] = MappingProxyType(
    {".npz": _npz, ".nc": _netcdf, ".x3p": _x3p, ".txt": _text, ".npy": _npy, ".vti": _vti}
)
_OF_A_SOLUTION: Mapping[str, Callable[[Solution | TangentialSolution, Path], None]] = MappingProxyType(
    {".nc": _solution, ".vti": _solution_vti}
)
_OF_A_CURVE: Mapping[str, Callable[..., None]] = MappingProxyType({".nc": write_netcdf, ".csv": write_csv})
