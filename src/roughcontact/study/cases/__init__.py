"""The cases of the package and those of the user, by name."""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib import import_module
from types import MappingProxyType, ModuleType
from typing import TYPE_CHECKING

from roughcontact.recipe.texts import choose
from roughcontact.study.case import Case
from roughcontact.study.study_errors import StudyError

if TYPE_CHECKING:  # tools that bundle programs read this
    from roughcontact.study.cases import (
        adhesion_case,  # noqa: F401
        asperities_case,  # noqa: F401
        cells_case,  # noqa: F401
        curve_case,  # noqa: F401
        job_case,  # noqa: F401
        joint_case,  # noqa: F401
        lines_case,  # noqa: F401
        loop_case,  # noqa: F401
        patch_case,  # noqa: F401
        slip_case,  # noqa: F401
        yielding_case,  # noqa: F401
    )

__all__ = ["CASES", "find_case"]

# The module of a case is imported when the case is first used.
_NAMES = (
    "adhesion",
    "asperities",
    "cells",
    "curve",
    "job",
    "joint",
    "lines",
    "loop",
    "patch",
    "slip",
    "yielding",
)
CASES: Mapping[str, str] = MappingProxyType({name: f"{__name__}.{name}_case:CASE" for name in _NAMES})
_OWN = "or give your own case in Python as module:attribute"


def find_case(name: str) -> Case:
    """Return a case by its name.

    Parameters
    ----------
    name : str
        Name of a case of the package, or ``"module:attribute"`` for a `Case` of the user.

    Returns
    -------
    Case
        The case.

    Raises
    ------
    StudyError
        If there is no such case.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.study.find_case("curve").parameters.model_fields["loads"].default
    30
    """
    place = CASES.get(name, name)
    if re.fullmatch(r"[\w.]+:\w+", place) is None:
        raise StudyError(f"there is no case {name!r}: {choose(name, sorted(CASES))}, {_OWN}", place="case")
    module, _, attribute = place.partition(":")
    found = getattr(_module(module, name), attribute, None)
    if not isinstance(found, Case):
        raise StudyError(
            f"the case {name!r} does not exist: {module} has no Case named {attribute!r}, such as "
            f"{attribute} = Case(...)",
            place="case",
        )
    return found


def _module(module: str, name: str) -> ModuleType:
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        top = module.partition(".")[0]
        if error.name is None or error.name.partition(".")[0] != top:
            raise StudyError(
                f"the case {name!r} needs the module {error.name}", "install it", "case"
            ) from error
        raise StudyError(
            f"the case {name!r} does not exist: no module {error.name} is found",
            f"run in the folder that contains {top}, or add this folder to PYTHONPATH",
        ) from error
    except Exception as error:  # the import runs code of the user, which may raise anything
        raise StudyError(
            f"the module of the case {name!r} cannot be imported: {type(error).__name__}: {error}",
            place="case",
        ) from error
