"""Theory: pure functions of numbers and of spectral moments, for comparison with computed curves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.late import late_names, open_name

_LATE = late_names(__spec__)
if TYPE_CHECKING or _LATE is None:
    from roughcontact.theory import law as law, laws as laws
    from roughcontact.theory.adhesive import (
        adhesive_asperities as adhesive_asperities,
        adhesive_sphere as adhesive_sphere,
        adhesive_wave as adhesive_wave,
        bearing_area_model as bearing_area_model,
        maugis as maugis,
        pastewka_robbins as pastewka_robbins,
        persson_tosatti as persson_tosatti,
    )
    from roughcontact.theory.asperity_models import (
        asperities as asperities,
        bush_gibson_thomas as bush_gibson_thomas,
        greenwood_williamson as greenwood_williamson,
        interaction as interaction,
    )
    from roughcontact.theory.joints import (
        cattaneo as cattaneo,
        conductance as conductance,
        holm as holm,
        jaeger as jaeger,
        joint as joint,
        leakage as leakage,
        mindlin as mindlin,
        thermal as thermal,
        ultrasound as ultrasound,
    )
    from roughcontact.theory.persson_theory import (
        persson as persson,
        persson_friction as persson_friction,
        persson_plastic as persson_plastic,
        persson_separation as persson_separation,
    )
    from roughcontact.theory.plastic_asperities import (
        chang_etsion_bogy as chang_etsion_bogy,
        kogut_etsion as kogut_etsion,
        plasticity as plasticity,
        pullen_williamson as pullen_williamson,
    )
    from roughcontact.theory.random_surfaces import nayak as nayak, waves as waves
    from roughcontact.theory.spheres_and_punches import (
        hertz as hertz,
        power_law_indenter as power_law_indenter,
        punch as punch,
        rough_sphere as rough_sphere,
    )
    from roughcontact.theory.springs import (
        beat_wave as beat_wave,
        cosine as cosine,
        gaussian_heights as gaussian_heights,
        height_distribution as height_distribution,
        stepped as stepped,
        two_cosines as two_cosines,
    )
    from roughcontact.theory.stiffness_laws import (
        finite_size as finite_size,
        pohrt_popov as pohrt_popov,
        rough_square as rough_square,
    )

__all__ = [name for name in _LATE or globals() if not name.startswith("_")]


if not TYPE_CHECKING:  # to a type checker, the module would have any name

    def __getattr__(name: str) -> Any:
        return open_name(globals(), _LATE, name)


def __dir__() -> list[str]:
    return __all__
