"""The command ``doctor``: which parts are installed, whether they work, and the facts for a report of a defect.

It must work in broken installations. Therefore each part imports its modules late, a failure is one more problem in
the list, and the check runs in a second process, because wrong machine code would end this one.
"""

from __future__ import annotations

import os
import platform
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from importlib import import_module
from importlib.util import find_spec
from json import dumps, loads
from pathlib import Path
from shutil import which
from typing import Any

import typer

import roughcontact
from roughcontact.cli.exits import MISSED
from roughcontact.cli.option_groups import option
from roughcontact.files.installed import broken_package, requirements
from roughcontact.version import __version__

__all__ = ["EXAMPLES", "EXTRAS", "doctor"]

EXAMPLES = {
    "doctor": """
roughcontact doctor
roughcontact doctor --json
"""
}
# The purpose of each extra for users; the other extras are for work on this package.
EXTRAS = {
    "formats": "files of some forty instruments",
    "page": "the page in the browser, 'roughcontact serve'",
    "mpi": "one surface on several processes",
    "cluster": "studies on Dask",
    "testing": "strategies of Hypothesis for your own tests",
    "notebook": "bars in notebooks while something is computed",
}
_VARIABLES = (
    *("ROUGHCONTACT_CPU", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "OPENBLAS_CORETYPE", "MKL_NUM_THREADS"),
    *("XDG_CACHE_HOME", "PYTHONPATH"),
)
_CHECK = (
    "import json; from roughcontact.evaluation.self_check import self_check; print(json.dumps(self_check()))"
)
_PATIENCE = 120  # [s] for the check, which takes a second or two
_PROBLEM = "problem"
_Facts = Iterator[tuple[str, Any]]  # facts by their names; problems have the name _PROBLEM


def doctor(*, json: bool = option("One JSON object on standard output.", default=False)) -> None:
    """Check this installation, and print the facts that a report of a defect needs."""
    record: dict[str, Any] = {"command": "doctor"}
    problems: list[str] = []
    for title, facts in _PARTS.items():
        told = record[title] = dict[str, Any]()
        for name, value in _whatever_happens(title, facts):
            if name == _PROBLEM:
                problems.append(value)
            else:
                told[name] = value
        if told and not json:
            typer.echo("\n".join([title, *(f"  {name:<22} {_shown(value)}" for name, value in told.items())]))
    record["problems"] = list(dict.fromkeys(problems))
    if json:
        typer.echo(dumps(record))
    else:
        typer.echo("\n".join([f"problems: {len(record['problems']) or 'none'}", *record["problems"]]))
        typer.echo(_report_to(), err=True)
    if problems:
        raise typer.Exit(MISSED)


def _shown(value: Any) -> str:
    return f"{value:.2g}" if isinstance(value, float) else str(value)


def _whatever_happens(title: str, facts: Callable[[], _Facts]) -> _Facts:
    """Yield facts until one fails, then the reason as a problem; the user's home is not named."""
    try:
        for name, value in facts():
            yield name, _without_home(value)
    except Exception as error:  # of any package, which may be broken in any way
        lines = str(error).strip().splitlines() or [""]
        words = broken_package(error) or f"{title}: {type(error).__name__}: {lines[0]}"
        yield _PROBLEM, _without_home(words)


def _without_home(value: Any) -> Any:
    if isinstance(value, int | float):
        return value
    text, home = str(value), os.path.expanduser("~")
    for each in (home, os.path.realpath(home)):
        text = text.replace(each, "~") if len(each) > 1 else text
    return text


def _python() -> _Facts:
    yield "roughcontact", __version__
    yield "in", Path(roughcontact.__file__).parent
    yield "python", f"{platform.python_version()}, {platform.python_implementation()}"
    yield "run by", sys.executable
    yield "system", platform.platform()
    yield "processor", f"{platform.machine()}, {os.cpu_count()} cores"
    yield from ((name, os.environ[name]) for name in _VARIABLES if name in os.environ)


def _packages() -> _Facts:
    for wanted in requirements():
        if wanted.extra:
            continue
        yield wanted.name, wanted.version or "missing"
        if wanted.problem is not None:
            yield _PROBLEM, wanted.problem
        else:
            yield from _whatever_happens(wanted.name, partial(_imported, wanted.name.replace("-", "_")))


def _imported(module: str) -> _Facts:
    import_module(module)
    yield from ()


def _extras() -> _Facts:
    for extra, purpose in EXTRAS.items():
        wanted = [each for each in requirements() if each.extra == extra]
        missing = [each.name for each in wanted if each.problem is not None]
        install = f"{sys.executable} -m pip install 'roughcontact[{extra}]'"
        needs = f"missing {', '.join(missing)}, for {purpose}; run: {install}"
        yield extra, needs if missing else ", ".join(f"{each.name} {each.version}" for each in wanted)


def _machine_code() -> _Facts:
    from roughcontact.kernels.processor import VARIABLE, is_off, processor

    if is_off():
        yield "made for", f"nothing: {VARIABLE} is off, NumPy and SciPy do everything"
        return
    yield "made for", processor().name
    from roughcontact.kernels.loader import is_available

    yield "works", is_available()
    if not is_available():
        yield _PROBLEM, "no machine code can be made, so that NumPy and SciPy do everything, more slowly"


def _cache() -> _Facts:
    from roughcontact.kernels.disk import cache_folder, private

    folder = cache_folder()
    files = [*folder.glob("*.o")]
    yield "folder", folder
    yield "holds", f"{len(files)} files, {sum(file.stat().st_size for file in files) / 1e6:.1f} MB"
    place = next(each for each in (folder, *folder.parents) if each.exists())
    kept = private(place) is not None and os.access(place, os.W_OK)
    yield "writable", kept
    if not kept:
        yield (
            _PROBLEM,
            f"machine code cannot be kept in {folder}, so that each process compiles it again: make {place} "
            "a folder that only you can write to",
        )


def _threads() -> _Facts:
    from roughcontact.threads import controller, limits, threads

    numbers = limits()
    yield "sums", f"{threads()}, by {min(numbers, key=numbers.__getitem__)}"
    import_module("scipy.linalg")  # brings its BLAS
    for each in controller().info():
        kernel = each.get("architecture", "unknown")
        words = f"{each['internal_api']} {each['version']}, kernel {kernel}, threads {each['num_threads']}"
        yield Path(each["filepath"]).name, words


def _memory() -> _Facts:
    from roughcontact.contact.memory_needed import largest_maps
    from roughcontact.memory import free_memory, gigabytes, most_memory

    yield "free", gigabytes(free_memory())
    yield "at most", f"{gigabytes(most_memory())} with the swap space"
    light, full = largest_maps(free_memory())
    yield "largest surface", f"{light} x {light} cells for light loads, {full} x {full} in full contact"


def _processes() -> _Facts:
    found = [name for name in ("mpiexec", "mpirun", "srun", "sbatch") if which(name)]
    yield "launchers", ", ".join(found) or "none"


def _devices() -> _Facts:
    for name in ("torch", "cupy"):
        if find_spec(name) is None:
            yield name, "not installed"
            continue
        yield from _whatever_happens(name, partial(_device, name))


def _device(name: str) -> _Facts:
    module = import_module(name)
    count = module.cuda.device_count() if name == "torch" else module.cuda.runtime.getDeviceCount()
    yield name, f"{module.__version__}, {count} GPUs"


def _check() -> _Facts:
    found, problem = _checked({})
    yield from found.items()
    yield "sphere beside Hertz", "right" if problem is None else "WRONG"
    if problem is not None:
        yield _PROBLEM, f"the check fails: {problem}"
        if _checked({"ROUGHCONTACT_CPU": "off"})[1] is None:
            yield _PROBLEM, "without machine code it is right: set ROUGHCONTACT_CPU=off until this is mended"


def _checked(environment: Mapping[str, str]) -> tuple[dict[str, float], str | None]:
    """Run the check in a second process; return its numbers, and the problem if there is one."""
    from roughcontact.evaluation.self_check import LIMITS

    answer = subprocess.run(
        [sys.executable, "-P", "-c", _CHECK],
        capture_output=True,
        encoding="utf-8",
        errors="replace",
        env=os.environ | environment,
        timeout=_PATIENCE,
        check=False,
    )
    if answer.returncode < 0:
        return {}, f"it was ended by {signal.Signals(-answer.returncode).name}"
    if answer.returncode > 0:
        return {}, (answer.stderr.strip().splitlines() or ["it ended without a message"])[-1]
    found = loads(answer.stdout)
    wrong = [name for name, limit in LIMITS.items() if not found[name] <= limit]
    return found, f"{' and '.join(wrong)} of a pressed sphere outside the tolerance" if wrong else None


def _report_to() -> str:
    """Return the advice below the facts."""
    from importlib.metadata import PackageNotFoundError, metadata

    try:
        addresses = [text for text in metadata("roughcontact").get_all("Project-URL", []) if "Issues" in text]
    except PackageNotFoundError:
        addresses = []
    where = addresses[0].partition(", ")[2] if addresses else "the issue tracker of the project"
    return (
        f"To report a defect, open an issue at {where}: paste the lines above, what you ran, and the whole message. "
        "For a weakness of security, follow SECURITY.md."
    )


_PARTS: Mapping[str, Callable[[], _Facts]] = {
    "python": _python,
    "packages": _packages,
    "extras": _extras,
    "machine code": _machine_code,
    "cache of machine code": _cache,
    "threads": _threads,
    "memory": _memory,
    "processes": _processes,
    "devices": _devices,
    "check": _check,
}
