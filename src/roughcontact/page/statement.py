"""An answer of the page as the commands and as the Python that give the same numbers."""

from __future__ import annotations

import math
import shlex
from dataclasses import dataclass

from roughcontact.files.quantity import LENGTH, PRESSURE, parse, parse_number
from roughcontact.page.jobs.conducting import conducting_pair
from roughcontact.page.preparation_calls import calls_of, written_value
from roughcontact.page.recipe import Bodies, FileSource, MadeSource, PageLoad, PageLoads, PageRecipe

__all__ = ["Statement", "stated"]

_MADE, _PREPARED = "rough.npz", "prepared.npz"
_OF_PRESS = {"--despike", "--level"}  # steps that the commands that press take themselves, in this order


@dataclass(frozen=True, slots=True)
class Statement:
    """Commands for a shell, one a line, and a program in Python."""

    command: str
    python: str


def stated(recipe: PageRecipe, file: str) -> Statement:
    """Return the recipe of a surface, a load or a curve as commands and as Python.

    Parameters
    ----------
    recipe : PageRecipe
    file : str
        How the user calls the measured file.
    """
    return Statement("\n".join(_commands(recipe, file)), "\n".join(_python(recipe, file)) + "\n")


def _commands(recipe: PageRecipe, file: str) -> list[str]:
    source, lines = recipe.source, []
    steps = [part for call in calls_of(recipe.preparation) for part in call.options]
    reading: list[str] = []
    if isinstance(source, MadeSource):
        lines.append(_line("surface", "make", _MADE, *_made_options(source)))
        file = _MADE
    else:
        reading = _reading_options(source)
    pressed = recipe.load is not None or recipe.loads is not None
    if not {part for part in steps if part.startswith("--")} <= _OF_PRESS or "quadratic" in steps:
        lines.append(_line("surface", "prepare", file, _PREPARED, *reading, *steps))
        file, reading, steps = _PREPARED, [], ["--level", "none"]
    elif pressed and "--level" not in steps:
        steps = [*steps, "--level", "none"]
    if not pressed:
        if file != _PREPARED:
            lines.append(_line("surface", "info", file, *(part for part in reading if part not in _OF_GRID)))
        return lines
    bodies = _body_options(recipe.bodies)
    if recipe.load is not None:
        load = [f"--{recipe.load.control}", recipe.load.text]
        lines.append(_line("press", file, *reading, *steps, *load, *bodies))
    if recipe.loads is not None:
        beside = _beside_options(recipe.loads, recipe.bodies)
        lines.append(_line("curve", file, *reading, *steps, *_loads_options(recipe.loads), *bodies, *beside))
    return lines


_OF_GRID = {"--periodic", "--free"}  # which only commands take that do something with the surface


def _line(*parts: str) -> str:
    return shlex.join(["roughcontact", *parts])


def _made_options(source: MadeSource) -> list[str]:
    options = [
        "--hurst",
        source.hurst,
        "--rms",
        source.rms,
        "--size",
        source.size,
        "--points",
        str(source.points),
    ]
    options += ["--seed", str(source.seed)]
    options += [] if source.rolloff is None else ["--rolloff", source.rolloff]
    return [*options, "--periodic"] if source.periodic else options


def _reading_options(source: FileSource) -> list[str]:
    options: list[str] = []
    for name, value in (("--channel", source.channel), ("--unit", source.unit)):
        options += [] if value is None else [name, value]
    if source.width is not None:
        options += ["--size", source.width if source.height is None else f"{source.height} x {source.width}"]
    if source.periodic is not None:
        options.append("--periodic" if source.periodic else "--free")
    return options


def _body_options(bodies: Bodies) -> list[str]:
    options: list[str] = []
    if bodies.materials is not None:
        options += ["--materials", ",".join(bodies.materials)]
    for name in ("modulus", "young", "poisson", "young2", "poisson2", "hardness"):
        value = getattr(bodies, name)
        options += [] if value is None else [f"--{name}", value]
    return options


def _loads_options(loads: PageLoads) -> list[str]:
    if loads.values is not None:
        return [f"--{loads.control}s", ",".join(repr(value) for value in loads.values)]
    if loads.ends is None:
        return []
    return [f"--{loads.control}s", f"{loads.start}:{loads.end}:{loads.count}"]


def _beside_options(loads: PageLoads, bodies: Bodies) -> list[str]:
    """Return what is asked for beside a curve."""
    options = ["--theory", ",".join(loads.theories)] if loads.theories else []
    pair = conducting_pair(bodies) if loads.conducting else None
    if pair is None:
        return options
    return [*options, "--resistivity", ",".join(pair), "--conductivity", ",".join(pair)]


def _python(recipe: PageRecipe, file: str) -> list[str]:
    source = recipe.source
    spaced = recipe.loads is not None and recipe.loads.values is None and recipe.loads.ends is not None
    lines = ["import numpy as np", ""] if spaced or isinstance(source, MadeSource) else []
    lines += ["import roughcontact as rc", ""]
    lines += _made(source) if isinstance(source, MadeSource) else [_read(source, file)]
    lines += [call.python for call in calls_of(recipe.preparation)]
    if recipe.load is None and recipe.loads is None:
        return lines
    lines.append(f"modulus = {_modulus(recipe.bodies)}")
    hardness = _hardness(recipe.bodies)
    if recipe.load is not None:
        lines.append(f"solution = rc.press(surface, modulus, {_load(recipe.load)}{hardness})")
    if recipe.loads is not None:
        lines.append(f"curve = rc.loading_curve(surface, modulus{_loads(recipe.loads)}{hardness})")
        lines += _beside(recipe.loads, recipe.bodies, hardness)
    return lines


def _beside(loads: PageLoads, bodies: Bodies, hardness: str) -> list[str]:
    lines: list[str] = []
    if loads.theories:
        names = ", ".join(written_value(name) for name in loads.theories)
        lines.append(f"theories = rc.loading_laws(surface, modulus, [{names}]{hardness})")
        lines.append("comparisons = [curve.compare(theory) for theory in theories]")
    pair = conducting_pair(bodies) if loads.conducting else None
    if pair is not None:
        lines.append(f"bodies = [rc.handbook(name) for name in {list(pair)!r}]".replace("'", '"'))
        numbers = ("resistivities=[body.resistivity", "conductivities=[body.conductivity")
        lines.append(
            f"conductance = rc.conductance(curve, {', '.join(f'{each} for body in bodies]' for each in numbers)})"
        )
    return lines


def _made(source: MadeSource) -> list[str]:
    spacing = parse(source.size, LENGTH) / source.points
    repeats = ", periodic=True" if source.periodic else ""
    rolloff = "" if source.rolloff is None else f", rolloff={parse(source.rolloff, LENGTH)!r}"
    waves = f"hurst={float(source.hurst)!r}, rms={parse(source.rms, LENGTH)!r}{rolloff}"
    return [
        f"grid = rc.Grid(({source.points}, {source.points}), {spacing!r}{repeats})",
        f"surface = rc.self_affine(grid, {waves}, rng=np.random.default_rng({source.seed}))",
    ]


def _read(source: FileSource, file: str) -> str:
    given = {
        "channel": source.channel,
        "unit": source.heights_in,
        "size": source.size,
        "periodic": source.periodic,
    }
    named = [f"{name}={written_value(value)}" for name, value in given.items() if value is not None]
    return f"surface = rc.read({', '.join([written_value(file), *named])})"


def _modulus(bodies: Bodies) -> str:
    if bodies.materials is not None:
        return f"rc.reduced_modulus({', '.join(_named(name) for name in bodies.materials)})"
    if bodies.modulus is not None:
        return repr(parse(bodies.modulus, PRESSURE))
    solids = [(bodies.young, bodies.poisson), (bodies.young2, bodies.poisson2)]
    written = [
        f"rc.Solid({parse(young, PRESSURE)!r}, {parse_number(poisson or '', '0.3')!r})"
        for young, poisson in solids
        if young is not None
    ]
    return f"rc.reduced_modulus({', '.join(written)})"


def _named(name: str) -> str:
    if name == "rigid":
        return f'rc.Solid(float("{math.inf}"), 0.0)'
    return f"rc.handbook({written_value(name)}).solid"


def _hardness(bodies: Bodies) -> str:
    text = bodies.hardness
    if text is None:
        return ""
    value = (
        f"rc.handbook({written_value(text)}).hardness" if text[:1].isalpha() else repr(parse(text, PRESSURE))
    )
    return f", hardness={value}"


def _load(load: PageLoad) -> str:
    return f"{load.control}={load.value!r}"


def _loads(loads: PageLoads) -> str:
    if loads.values is not None:
        return f", {loads.control}s=[{', '.join(repr(value) for value in loads.values)}]"
    if loads.ends is None:
        return ""
    low, high = loads.ends
    return f", {loads.control}s=np.geomspace({low!r}, {high!r}, {loads.count})"
