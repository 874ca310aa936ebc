"""Figures of the thesis: one file each, with its parameters, its case and its picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.late import late_names, open_name

_LATE = late_names(__spec__)
if TYPE_CHECKING or _LATE is None:
    from roughcontact_thesis import bounds as bounds, calibration as calibration
    from roughcontact_thesis.figures import (
        FIGURES as FIGURES,
        EnsembleFigure as EnsembleFigure,
        SimpleFigure as SimpleFigure,
        drawn as drawn,
        figure as figure,
        is_ensemble as is_ensemble,
        module as module,
        verdicts as verdicts,
    )
    from roughcontact_thesis.reproduce import (
        averages_of as averages_of,
        planned as planned,
        run_study as run_study,
    )
    from roughcontact_thesis.verdict import Verdict as Verdict

__all__ = [name for name in _LATE or globals() if not name.startswith("_")]


if not TYPE_CHECKING:  # to which it would be a module that has any name

    def __getattr__(name: str) -> Any:
        return open_name(globals(), _LATE, name)


def __dir__() -> list[str]:
    return __all__
