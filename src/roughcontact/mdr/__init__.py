"""The method of dimensionality reduction: bodies of revolution and rough lines on springs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.late import late_names, open_name

_LATE = late_names(__spec__)
if TYPE_CHECKING or _LATE is None:
    from roughcontact.mdr import foundation as foundation
    from roughcontact.mdr.adhesive_bodies import adhesion as adhesion, adhesive_path as adhesive_path
    from roughcontact.mdr.bodies import indentation as indentation, indenter as indenter
    from roughcontact.mdr.lines import (
        equivalent_line as equivalent_line,
        lattice_sums as lattice_sums,
        line_curves as line_curves,
        line_scan as line_scan,
        random_lines as random_lines,
        rough_line as rough_line,
    )
    from roughcontact.mdr.tangential_loading import slip_history as slip_history, tangential as tangential
    from roughcontact.mdr.viscoelasticity import (
        sliding_friction as sliding_friction,
        viscoelastic_history as viscoelastic_history,
    )

__all__ = [name for name in _LATE or globals() if not name.startswith("_")]


if not TYPE_CHECKING:  # to a type checker, the module would have any name

    def __getattr__(name: str) -> Any:
        return open_name(globals(), _LATE, name)


def __dir__() -> list[str]:
    return __all__
