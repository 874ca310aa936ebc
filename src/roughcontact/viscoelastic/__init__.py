"""Viscoelastic bodies: materials, contact in time, steady sliding, and elastic curves transferred to them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.late import late_names, open_name

_LATE = late_names(__spec__)
if TYPE_CHECKING or _LATE is None:
    from roughcontact.viscoelastic.conversions import (
        from_creep as from_creep,
        in_series as in_series,
        reduced as reduced,
    )
    from roughcontact.viscoelastic.elastic_transfer import (
        ElasticCurve as ElasticCurve,
        Transfer as Transfer,
        transfer as transfer,
    )
    from roughcontact.viscoelastic.fitted import from_dma as from_dma, power_law as power_law
    from roughcontact.viscoelastic.models import (
        kelvin_voigt as kelvin_voigt,
        maxwell as maxwell,
        standard_solid as standard_solid,
        viscous as viscous,
    )
    from roughcontact.viscoelastic.prony_series import Creep as Creep

__all__ = [name for name in _LATE or globals() if not name.startswith("_")]


if not TYPE_CHECKING:  # to a type checker, the module would have any name

    def __getattr__(name: str) -> Any:
        return open_name(globals(), _LATE, name)


def __dir__() -> list[str]:
    return __all__
