"""Write a surface or a loaded state in the format of the extension."""

from __future__ import annotations

import os
import struct
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import quoteattr

import numpy as np
import numpy.typing as npt

from roughcontact.adhesion.adhesive_curve import AdhesiveCurve
from roughcontact.adhesion.adhesive_state import AdhesiveState
from roughcontact.adhesion.detachment_curve import DetachmentCurve
from roughcontact.adhesion.detachment_state import DetachmentState
from roughcontact.arrays import on_host
from roughcontact.contact.curve import Curve
from roughcontact.contact.dataset import numbers_dataset, solution_dataset, solution_maps
from roughcontact.contact.loop import Loop
from roughcontact.contact.problem import Body
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError
from roughcontact.evaluation.contact_flux import ContactFlux
from roughcontact.evaluation.interface_calculix import calculix_text
from roughcontact.evaluation.interface_columns import column_text, moose_text
from roughcontact.evaluation.interface_table import InterfaceTable
from roughcontact.evaluation.interface_text import UNIT_SYSTEMS, abaqus_text, lammps_text
from roughcontact.files.aside import WriteError, require_target, written_aside
from roughcontact.files.numpy_files import npy_bytes, npz_bytes, write_npy
from roughcontact.files.provenance import provenance
from roughcontact.files.standard_streams import kind_of, standard, write_standard_output
from roughcontact.files.surface_dataset import dataset_without_heights, surface_dataset
from roughcontact.files.text import text_bytes
from roughcontact.files.write import netcdf_bytes, require_netcdf, write_csv, write_netcdf, write_text
from roughcontact.files.x3p import x3p_bytes
from roughcontact.friction.slip_curve import SlipCurve
from roughcontact.friction.slip_solution import TangentialSolution
from roughcontact.grid import AnyGrid, RadialGrid
from roughcontact.slabs.slab_array import SlabArray
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.surface import Surface
from roughcontact.viscoelastic.viscoelastic_curve import ViscoelasticCurve

if TYPE_CHECKING:
    pass

__all__ = ["csv_of", "require_surface_file", "write", "write_solution"]

Field = npt.NDArray[np.generic]
# Components by index, name and sign in a picture whose rows are reversed.
_UPRIGHT = ((0, "x", 1.0), (1, "y", -1.0))
Pressed = Solution | TangentialSolution | AdhesiveState | DetachmentState
Curves = Curve | Loop | AdhesiveCurve | DetachmentCurve | SlipCurve | ViscoelasticCurve
Writable = Surface | Pressed | Curves | InterfaceTable | ContactFlux


def write(
    what: Writable, path: str | os.PathLike[str], *, units: str = "SI", dialect: str | None = None
) -> None:
    """Write a surface, a solution or a curve; the file appears whole or not at all.

    ==========  ==================================================================================================
    ``.npz``    a surface: heights, spacing, unit, periodic, history; read back to the last bit
    ``.nc``     a surface, a solution, a flux, a curve or a loop, NetCDF-4; the surface in it is read back to the last
                bit (of a loop the flattened one as the channel ``flattened_heights``), a loading curve by `read_curve`,
                with adhesion by `read_adhesive_curve`, of a detachment by `read_detachment_curve`
    ``.csv``    a curve, a loop, or the table of an interface: one line a load; the flux of a contact: one line a spot;
                with ``dialect="moose"`` rising columns for MOOSE
    ``.x3p``    a surface, ISO 25178-72 in double precision; read back to the last bit, except ``periodic`` and the
                history, for which the format has no place
    ``.txt``    a surface: rows of heights under the header that Gwyddion writes, a line as places and heights;
                read back except ``periodic`` and the history, the spacing to rounding; the table of an interface:
                columns under a header with names and units
    ``.npy``    only the heights of a surface [m]: state unit and size when you read it
    ``.vti``    a surface or the fields of a solution for ParaView; y points up, as in its pictures
    ``.inp``    the table of an interface: pressure against overclosure for Abaqus, or with ``dialect="calculix"`` for
                CalculiX, in the `units` of a model
    ``.table``  the table of an interface: energy and force against mean gap for LAMMPS (``units si``)
    ==========  ==================================================================================================

    A surface in slabs is written as ``.npy`` or ``.nc``, a solution in slabs as ``.nc``: one file, by all processes.

    Parameters
    ----------
    what : Surface, Solution, Curve or another answer
        Object to write.
    path : str or path
        File to write; an existing file is replaced. ``"-"`` is standard output, for a surface as ``.npz``, ``"nc:-"``
        for one of the other formats.
    units : {"SI", "mm"}
        For ``.inp``: metres, newtons and pascals, or millimetres, newtons and megapascals. All other files are in SI.
    dialect : {"abaqus", "calculix", "csv", "moose"}, optional
        The program that reads the table of an interface; by default Abaqus for ``.inp``.

    Raises
    ------
    InputError
        If `units` is neither of these, or not SI for another file than ``.inp``; if such a file has no such dialect.
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
    if units not in UNIT_SYSTEMS or (units != "SI" and kind_of(path) != ".inp"):
        raise InputError(
            f"{path} is not written in the units {units!r}",
            "omit units, or choose SI or mm for a file .inp",
            "units",
        )
    if isinstance(what, InterfaceTable):
        _write_interface(what, path, units, dialect)
        return
    if dialect is not None:
        raise InputError("only the table of an interface has dialects", "omit dialect", "dialect")
    if isinstance(what, Curves):
        kind = _require_kind(path, type(what).__name__, _OF_A_CURVE)
        _OF_A_CURVE[kind](what.to_dataset(), path)
        return
    if isinstance(what, ContactFlux):
        _OF_A_FLUX[_require_kind(path, type(what).__name__, _OF_A_FLUX)](what, path)
        return
    if not isinstance(what, Surface | Pressed):
        raise WriteError(f"cannot write a {type(what).__name__}", "give a Surface, a solution or a curve")
    field = what.heights if isinstance(what, Surface) else getattr(what, "pressure", None)
    if isinstance(field, SlabArray):
        _require_kind(path, f"{type(what).__name__} in slabs", _IN_SLABS[type(what)])
        _write_in_slabs(what, path)
        return
    formats: Mapping[str, Callable[[Any], bytes]] = (
        _OF_A_SURFACE if isinstance(what, Surface) else _OF_A_SOLUTION
    )
    hint = "; write solution.problem.surface for only its heights" if isinstance(what, Solution) else ""
    kind = _require_kind(path, type(what).__name__, formats, hint)
    encoded = analysed_on_host(formats[kind])
    here = what.on_host() if isinstance(what, Solution | TangentialSolution) else what
    if standard(path) is not None:
        write_standard_output(encoded(here))
        return
    with written_aside(path) as aside:
        aside.write_bytes(encoded(here))


def csv_of(curve: Curves | InterfaceTable | ContactFlux, path: str | os.PathLike[str]) -> None:
    """Write a curve, a loop or a table as comma-separated values: one line a load, or a spot of a flux, in SI units.

    Parameters
    ----------
    curve : Curve, Loop, AdhesiveCurve, DetachmentCurve, SlipCurve, ViscoelasticCurve, InterfaceTable or ContactFlux
    path : str or path
        File to write, whatever its extension; an existing file is replaced.

    Raises
    ------
    WriteError
        If the file cannot be written.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> rc.loading_curve(ball, 1e9, forces=[1e-3, 2e-3]).to_csv("curve.csv")
    >>> with open("curve.csv") as file:
    ...     file.readline().startswith("force")
    True
    """
    write_csv(curve.to_dataset(), path, dimension="spot" if isinstance(curve, ContactFlux) else None)


def _write_in_slabs(what: Any, path: str | os.PathLike[str]) -> None:
    if isinstance(what, Solution):
        write_solution(what, path, provenance(what.problem.surface, modulus=what.problem.modulus))
    elif Path(path).suffix.casefold() == ".npy":
        write_npy(what.heights, path)
    else:
        write_netcdf(dataset_without_heights(what, {}), path, maps={"heights": what.heights})


def write_solution(
    solution: Solution, path: str | os.PathLike[str], lines: Mapping[str, str | float]
) -> None:
    """Write a loaded state as NetCDF-4 with lines of provenance; one in slabs by all processes.

    Raises
    ------
    WriteError
        If the file cannot be written.
    """
    pressure: Any = solution.pressure
    if isinstance(pressure, SlabArray):
        write_netcdf(numbers_dataset(solution), path, lines, solution_maps(solution))
    else:
        write_netcdf(solution_dataset(solution), path, lines)


def require_surface_file(path: str | os.PathLike[str], *, in_slabs: bool = False) -> None:
    """Refuse, before any work is done, a path to which `write` could not write a surface.

    Raises
    ------
    WriteError
        If its extension is not known or needs a package that is not installed, or there is no such folder, no
        permission, a folder of that name.
    """
    if in_slabs:
        _require_kind(path, "Surface in slabs", _IN_SLABS[Surface])
    _require_kind(path, "Surface", _OF_A_SURFACE)
    if standard(path) is None:
        require_target(path)


def _require_kind(path: str | os.PathLike[str], what: str, known: Iterable[str], hint: str = "") -> str:
    kind = kind_of(path)
    if kind not in known:
        raise WriteError(f"cannot write {path}: a {what} is written as one of {', '.join(known)}{hint}")
    if kind == ".nc":
        require_netcdf()
    return kind


def _flux_netcdf(flux: ContactFlux, path: str | os.PathLike[str]) -> None:
    problem = flux.solution.problem
    write_netcdf(flux.to_dataset(), path, provenance(problem.surface, modulus=problem.modulus))


def _vti(surface: Surface) -> bytes:
    return _vti_bytes({"heights": surface.heights}, surface.grid)


def _netcdf(surface: Surface) -> bytes:
    return netcdf_bytes(surface_dataset(surface))


def _solution(solution: Pressed) -> bytes:
    origin = _pressed(solution).problem
    lines = provenance(origin.surface, modulus=origin.modulus)
    return netcdf_bytes(solution.to_dataset().assign_attrs(lines))


def _solution_vti(solution: Pressed) -> bytes:
    pressed = _pressed(solution)
    fields = _fields(pressed, pressed.problem.surface)
    if isinstance(solution, TangentialSolution):
        fields |= _tangential_fields(solution)
    return _vti_bytes(fields, pressed.problem.operator.grid)


def _pressed(solution: Pressed) -> Solution | AdhesiveState | DetachmentState:
    """Return the state under the normal force only."""
    return solution.problem.pressed if isinstance(solution, TangentialSolution) else solution


def _fields(solution: Solution | AdhesiveState | DetachmentState, surface: Body | None) -> dict[str, Field]:
    heights = {} if surface is None else {"heights": surface.heights}
    return heights | {
        name: getattr(solution, name) for name in ("pressure", "displacement", "gap", "contact")
    }


def _tangential_fields(solution: TangentialSolution) -> dict[str, Field]:
    """Return components by name; those along y change their sign, because the rows of the picture are reversed."""
    vectors = {"traction": on_host(solution.traction), "slip": on_host(solution.slip)}
    parts = {
        f"{name}_{axis}": sign * field[at] for name, field in vectors.items() for at, axis, sign in _UPRIGHT
    }
    return parts | {"slipping": on_host(solution.slipping).astype(bool)}


def _write_interface(
    table: InterfaceTable, path: str | os.PathLike[str], units: str, dialect: str | None
) -> None:
    dialects = _OF_AN_INTERFACE[_require_kind(path, type(table).__name__, _OF_AN_INTERFACE)]
    name = next(iter(dialects)) if dialect is None else dialect
    if name not in dialects:
        choice = f"choose {' or '.join(dialects)}" if len(dialects) > 1 else "omit dialect"
        raise InputError(f"{path} is not written in the dialect {dialect!r}", choice, "dialect")
    if name == "csv":
        csv_of(table, path)
    else:
        write_text(dialects[name](table, **({} if units == "SI" else {"units": units})), path)


def _vti_bytes(fields: Mapping[str, npt.NDArray[Any]], grid: AnyGrid) -> bytes:
    """Return cell fields, each of the shape of the grid, as ImageData of VTK: an XML header, and the numbers appended.

    NaN stays NaN, truth values are 0 and 1.
    The first row is the top of the picture: rows are reversed, and y counts upwards from the lower left corner of the
    map.

    Raises
    ------
    ValueError
        If the grid has rings, which image data cannot hold.
    """
    if isinstance(grid, RadialGrid):
        raise InputError("ParaView's image data hold cells in rows, not rings", "write another format")
    ny, nx = (1, *grid.shape)[-2:]
    dy, dx = (grid.spacing[-1], *grid.spacing)[-2:]
    extent = f"0 {nx} 0 {ny if grid.ndim == 2 else 0} 0 0"
    arrays, blocks, offset = [], [], 0
    for name, values in fields.items():
        kind, dtype = ("UInt8", "u1") if values.dtype.kind == "b" else ("Float64", "<f8")
        numbers = np.ascontiguousarray(values[::-1] if grid.ndim == 2 else values, dtype=dtype).tobytes()
        arrays.append(
            f'<DataArray type="{kind}" Name={quoteattr(name)} format="appended" offset="{offset}"/>'
        )
        blocks += [struct.pack("<Q", len(numbers)), numbers]
        offset += 8 + len(numbers)
    head = (
        '<?xml version="1.0"?>\n'
        '<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
        f'<ImageData WholeExtent="{extent}" Origin="0 0 0" Spacing="{dx!r} {dy!r} {min(dx, dy)!r}">\n'
        f'<Piece Extent="{extent}">\n<CellData>\n'
        + "\n".join(arrays)
        + "\n</CellData>\n</Piece>\n</ImageData>\n"
        '<AppendedData encoding="raw">\n_'
    )
    return b"".join([head.encode(), *blocks, b"\n</AppendedData>\n</VTKFile>\n"])


_OF_A_SURFACE: Mapping[str, Callable[[Surface], bytes]] = MappingProxyType(
    {
        ".npz": npz_bytes,
        ".nc": _netcdf,
        ".x3p": x3p_bytes,
        ".txt": text_bytes,
        ".npy": npy_bytes,
        ".vti": _vti,
    }
)
_IN_SLABS: Mapping[type, tuple[str, ...]] = MappingProxyType({Surface: (".npy", ".nc"), Solution: (".nc",)})
_OF_A_SOLUTION: Mapping[str, Callable[[Solution | TangentialSolution], bytes]] = MappingProxyType(
    {".nc": _solution, ".vti": _solution_vti}
)
_OF_AN_INTERFACE: Mapping[str, Mapping[str, Callable[..., Any]]] = MappingProxyType(
    {
        ".csv": {"csv": csv_of, "moose": moose_text},
        ".inp": {"abaqus": abaqus_text, "calculix": calculix_text},
        ".table": {"lammps": lammps_text},
        ".txt": {"text": column_text},
    }
)
_OF_A_FLUX: Mapping[str, Callable[[ContactFlux, str | os.PathLike[str]], None]] = MappingProxyType(
    {".nc": _flux_netcdf, ".csv": csv_of}
)
_OF_A_CURVE: Mapping[str, Callable[..., None]] = MappingProxyType({".nc": write_netcdf, ".csv": write_csv})
