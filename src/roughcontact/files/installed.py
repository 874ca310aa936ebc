"""Packages that are not installed, or cannot be loaded: which one it is, and the command that mends it."""

from __future__ import annotations

import re
import sys
from importlib import import_module

from roughcontact.errors import InputError

__all__ = ["broken_package", "lacking"]

PACKAGE = "roughcontact"
_NAME = re.compile(r"[\w.-]+")


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
    """Return the error of a package of others that is missing or broken; None of every other error.

    A name that we ask a module for, and that it does not have, is a mistake of ours.
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
    """Return the package that raised an error, by its name and not its file, which bundles of programs do not have."""
    last = error.__traceback__
    while last is not None and last.tb_next is not None:
        last = last.tb_next
    return "" if last is None else str(last.tb_frame.f_globals.get("__name__")).partition(".")[0]


def _command(module: str, options: str = "") -> str:
    """Return the command that installs the package of a module, or all that is lacking where we do not require it."""
    from importlib.metadata import PackageNotFoundError, requires  # late: it brings the parser of e-mails

    try:
        required = requires(PACKAGE) or []
    except PackageNotFoundError:  # run from its source
        required = []
    wanted = (text.partition(";")[0].strip() for text in required)
    named = {_same(match[0]): text for text in wanted if (match := _NAME.match(text))}
    return f'run: {sys.executable} -m pip install {options}"{named.get(_same(module), PACKAGE)}"'


def _same(name: str) -> str:
    """Return a name of a package as the index compares it."""
    return re.sub(r"[-_.]+", "-", name).casefold()


def _line(error: ImportError) -> str:
    """Return what an error says, in one line; NumPy's takes a page."""
    return str(error).strip().partition("\n")[0].strip() or type(error).__name__
