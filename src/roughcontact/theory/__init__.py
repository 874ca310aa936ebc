"""Theory: pure functions of numbers and of spectral moments, beside every computed curve."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.late import late_names, open_name

_LATE = late_names(__spec__)
if TYPE_CHECKING or _LATE is None:
    from roughcontact.theory import (
        adhesive_asperities as adhesive_asperities,
        adhesive_sphere as adhesive_sphere,
        adhesive_wave as adhesive_wave,
        asperities as asperities,
        bearing_area_model as bearing_area_model,
        beat_wave as beat_wave,
        bush_gibson_thomas as bush_gibson_thomas,
        cattaneo as cattaneo,
        chang_etsion_bogy as chang_etsion_bogy,
        conductance as conductance,
        cosine as cosine,
        finite_size as finite_size,
        gaussian_heights as gaussian_heights,
        greenwood_williamson as greenwood_williamson,
        height_distribution as height_distribution,
        hertz as hertz,
        holm as holm,
        interaction as interaction,
        jaeger as jaeger,
        kogut_etsion as kogut_etsion,
        law as law,
        laws as laws,
        maugis as maugis,
        mindlin as mindlin,
        nayak as nayak,
        pastewka_robbins as pastewka_robbins,
        persson as persson,
        persson_plastic as persson_plastic,
        persson_separation as persson_separation,
        persson_tosatti as persson_tosatti,
        plasticity as plasticity,
        pohrt_popov as pohrt_popov,
        power_law_indenter as power_law_indenter,
        pullen_williamson as pullen_williamson,
        punch as punch,
        rough_sphere as rough_sphere,
        rough_square as rough_square,
        stepped as stepped,
        thermal as thermal,
        two_cosines as two_cosines,
        waves as waves,
    )

__all__ = [name for name in _LATE or globals() if not name.startswith("_")]


if not TYPE_CHECKING:  # to which it would be a module that has any name

    def __getattr__(name: str) -> Any:
        return open_name(globals(), _LATE, name)


def __dir__() -> list[str]:
    return __all__
