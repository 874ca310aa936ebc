"""Packages that are not installed or cannot be loaded: the name of the package, and the command that installs it."""

from __future__ import annotations

import re
import sys
from dataclasses import dataclass
from importlib import import_module

from roughcontact.errors import InputError

__all__ = ["Requirement", "broken_package", "lacking", "requirements"]

PACKAGE = "roughcontact"
_NAME = re.compile(r"[\w.-]+")
_WANTED = re.compile(r"([\w.-]+)[^;]*?>=([\d.]+)")
_BELOW = re.compile(r"""python_version < ['"]([\d.]+)""")
_EXTRA = re.compile(r"""extra == ['"](\w+)""")


@dataclass(frozen=True, slots=True)
class Requirement:
    """A package that this one or one of its extras requires, according to the metadata of the installation.

    Parameters
    ----------
    name, least : str
        Its name and lowest version.
    extra : str
        The extra that requires it; empty if it is always required.
    version : str or None
        The version that is installed.
    """

    name: str
    least: str
    extra: str
    version: str | None

    @property
    def problem(self) -> str | None:
        """What is wrong with it, and the command that repairs it; None if it is installed and new enough."""
        if self.version is not None and _parts(self.version) >= _parts(self.least):
            return None
        lack = "is not installed" if self.version is None else f"{self.version} is older than {self.least}"
        return f"the package {self.name} {lack}; {_command(self.name)}"


def requirements() -> list[Requirement]:
    """Return the packages that the metadata of the installation name for this Python.

    Raises
    ------
    PackageNotFoundError
        If this package is run from its source, without metadata.
    """
    from importlib.metadata import PackageNotFoundError, requires, version

    found = []
    for text in requires(PACKAGE) or []:
        wanted, below, extra = _WANTED.match(text), _BELOW.search(text), _EXTRA.search(text)
        if wanted is None or (below and sys.version_info >= _parts(below[1])):
            continue
        try:
            installed = version(wanted[1])
        except PackageNotFoundError:
            installed = None
        found.append(Requirement(wanted[1], wanted[2], extra[1] if extra else "", installed))
    return found


def lacking(*modules: str) -> tuple[str, str] | None:
    """Return what is wrong and the remedy if one of these modules cannot be imported; None if all can."""
    for module in modules:
        try:
            import_module(module)
        except ImportError as error:
            problem = f"the package {module}, which cannot be imported ({_line(error)})"
            return problem, _command(module)
    return None


def broken_package(error: BaseException) -> InputError | None:
    """Return the error about a third-party package that is missing or broken; None for every other error.

    Importing a name that a module does not have is a bug of this package.
    """
    if not isinstance(error, ImportError):
        return None
    asked = _raised_in(error)
    package = (error.name or asked).partition(".")[0]
    if package in sys.stdlib_module_names | {"", PACKAGE}:
        return None
    missing = isinstance(error, ModuleNotFoundError)
    if missing and error.name == package:
        return InputError(f"the package {package} is not installed", _command(package))
    if asked == PACKAGE and not missing:
        return None
    return InputError(
        f"the package {package} cannot be loaded ({_line(error)})", _command(package, "--force-reinstall ")
    )


def _raised_in(error: BaseException) -> str:
    """Return the package that raised an error, by its name and not by its file, which bundled programs do not have."""
    last = error.__traceback__
    while last is not None and last.tb_next is not None:
        last = last.tb_next
    return "" if last is None else str(last.tb_frame.f_globals.get("__name__")).partition(".")[0]


def _command(module: str, options: str = "") -> str:
    """Return the command that installs the package of a module, or all missing packages if this one is not required."""
    from importlib.metadata import PackageNotFoundError, requires  # late: it brings the parser of e-mails

    try:
        required = requires(PACKAGE) or []
    except PackageNotFoundError:  # run from its source
        required = []
    wanted = (text.partition(";")[0].strip() for text in required)
    named = {_same(match[0]): text for text in wanted if (match := _NAME.match(text))}
    return f'run: {sys.executable} -m pip install {options}"{named.get(_same(module), PACKAGE)}"'


def _parts(version: str) -> tuple[int, ...]:
    return tuple(map(int, re.findall(r"\d+", version)))


def _same(name: str) -> str:
    """Return the name of a package in the form that the index compares."""
    return re.sub(r"[-_.]+", "-", name).casefold()


def _line(error: ImportError) -> str:
    """Return the first line of the text of an error; NumPy's text fills a page."""
    return str(error).strip().partition("\n")[0].strip() or type(error).__name__
