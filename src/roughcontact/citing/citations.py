"""The parts of the program that a result or a job uses, and the references that are cited for them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import reduce
from pathlib import Path
from typing import Any

from roughcontact.citing.bibliography import Citations, references
from roughcontact.errors import InputError

__all__ = ["citations"]

# Words in the history of a surface (generator, preparation, reader), and the keywords of their references.
_HISTORY = {
    "inverse FFT": "fourier",
    "midpoint": "midpoint",
    "Gaussian filter": "filters",
    "by SurfaceTopography": "SurfaceTopography",
}
# Columns that a measure has added to a curve, and the files of the measures.
_MEASURED = {"transmissivity": "transmissivity", "gas_conductance_per_area": "conductance_parts"}
_UNKNOWN = "free or periodic"  # a job whose file states which


def citations(*answers: object) -> Citations:
    """Return the references behind results: method, bodies, hardness, adhesion, theories, surface, errors.

    The program itself always comes first. A curve does not contain its surface or its solver: pass these too, or pass
    the job. If a job does not state whether its surface is periodic, the influence functions of the free and of the
    periodic half-space are cited, unless a result passed with the job decides it.

    Parameters
    ----------
    *answers : Solution, Curve, Loop, AdhesiveState, TangentialSolution, LoadingLaw, Surface, path, ...
        Objects that the package returns, or the path of a job (.toml) or of a result that contains its recipe (.json,
        .nc).

    Returns
    -------
    Citations
        ``str`` of it is text, its `bibtex` BibTeX.

    Raises
    ------
    ValueError
        If an object is not of this package, or a file contains no recipe.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> loop = rc.loading_loop(ball, 1e9, forces=[1e-3, 5e-3], hardness=1e8)
    >>> [each.key for each in rc.citations(loop).references]
    ['roughcontact', 'Pohrt2013', 'Hintermueller2002', 'Dostal2005', 'Polonsky1999', 'Love1929', 'Almqvist2007']
    """
    names, sources = {"always"}, ""
    for answer in answers:
        if isinstance(answer, str | Path):
            from roughcontact.recipe.written import read_job  # late, with NumPy

            answer = read_job(Path(answer))
        if not _is_ours(answer):
            raise InputError(
                f"there are no references for {type(answer).__name__!r}, which is not of this package",
                "give a result, a surface, a law, a job, or the path of a job or result",
                "answers",
            )
        names |= set(_of_job(answer) if hasattr(answer, "NAME") else _of_answer(answer))
        if isinstance(source := getattr(answer, "source", None), str):
            sources += f"{source} "
    if _UNKNOWN in names and not names & {"free", "periodic"}:
        names |= {"free", "periodic"}
    return Citations(tuple(each for each in references() if each.keywords & names or each.is_in(sources)))


def _of_answer(answer: Any) -> Iterator[str]:
    """Yield the keywords of a result: the files of its class and of the classes of its parts, and their values."""
    yield from type(answer).__module__.split(".")
    kind = type(answer).__name__
    for line in getattr(answer, "provenance", ()):
        yield from (name for words, name in _HISTORY.items() if words in line)
    if kind in ("ContactProblem", "AdhesiveProblem") and _is_ours(answer.operator):
        from roughcontact.halfspace.operators.operator import geometry_of  # late, with NumPy

        yield from _body(geometry_of(answer.operator).value, answer.operator.grid.periodic)
    elif hasattr(answer, "periodic") and hasattr(answer, "geometry"):
        yield from _body(answer.geometry.value, answer.periodic)
    if (kind == "ContactProblem" and answer.plastic) or (kind == "Curve" and answer.flow is not None):
        yield "hardness"
    if kind in ("ContactProblem", "Flow") and answer.rise:
        yield "raised"
    if kind == "Adhesion":
        yield answer.law
    if kind in ("Curve", "ViscoelasticCurve"):
        yield from (name for column, name in _MEASURED.items() if column in answer.measured)
    if kind in ("LoadingLaw", "Comparison"):
        yield answer.name.lower()
    for each in fields(answer) if is_dataclass(answer) else ():
        value = getattr(answer, each.name)
        for part in value if isinstance(value, tuple) else (value,):
            if _is_ours(part):
                yield from _of_answer(part)


def _of_job(job: Any) -> Iterator[str]:
    """Yield the keywords of a job: the files of the functions that it calls, and the values of its fields."""
    from roughcontact.recipe.jobs import calls_of, known_names  # late, with NumPy
    from roughcontact.recipe.recipe_fields import value_of

    package = known_names()["rc"]
    homes = {"rc": package, "surface": package.Surface}
    for call in calls_of(job):
        root, *path = call.function.split(".")
        if root in homes:
            yield from reduce(getattr, path, homes[root]).__module__.split(".")
        if call.place in ("load", "loads", "shear", "pressure"):
            yield from call.named.keys() & {"hardness"}
            yield from {"raised"} & {call.named.get("flow")}
    if hasattr(job, "theories"):
        named = value_of(job.theories, "theory") or ()
        yield from (named,) if isinstance(named, str) else named
    if law := getattr(getattr(job, "adhesion", None), "law", None):
        yield law
    if getattr(getattr(job, "errors", None), "errors", False):
        yield "error_budget"
    if hasattr(job, "contact") and job.contact.profile is None:
        periodic = getattr(getattr(job.source, "lower", job.source), "periodic", False)
        periodic = periodic if job.preparation.crop is None else False
        yield _UNKNOWN if periodic is None else "periodic" if periodic else "free"


def _body(geometry: str, periodic: tuple[bool, ...]) -> Iterator[str]:
    """Yield the keywords of the body of a geometry."""
    if geometry == "surface":
        yield "periodic" if all(periodic) else "free"
    elif geometry != "ring":
        yield {"line": "line_contact", "foundation": "mdr"}[geometry]


def _is_ours(thing: object) -> bool:
    return type(thing).__module__.startswith("roughcontact.")
