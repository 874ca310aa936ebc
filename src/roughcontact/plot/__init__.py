"""Pictures: functions that draw on axes, and whole figures.

The first argument of a function is the object to draw, the second ``ax=None``, the Matplotlib axes to draw on; the
others are keywords. It returns the axes. Without axes it makes a figure of pyplot, which notebooks show. A function
whose name ends in ``figure`` makes a whole figure, without pyplot, which `save` writes as PNG, PDF or SVG.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.late import late_names, open_name

_LATE = late_names(__spec__)
if TYPE_CHECKING or _LATE is None:
    from roughcontact.labels.engineering_units import Scale as Scale
    from roughcontact.plot.canvas import (
        areal_figure as areal_figure,
        curve_figure as curve_figure,
        pressure_distribution_figure as pressure_distribution_figure,
        resistance_figure as resistance_figure,
        save as save,
        solution_figure as solution_figure,
        surface_figure as surface_figure,
    )
    from roughcontact.plot.creep_plot import creep_curve as creep_curve
    from roughcontact.plot.curves import (
        areal_curve as areal_curve,
        force_curve as force_curve,
        resistance_curve as resistance_curve,
    )
    from roughcontact.plot.detachment_plot import detachment_force as detachment_force
    from roughcontact.plot.distributions import (
        height_distribution as height_distribution,
        pressure_distribution as pressure_distribution,
    )
    from roughcontact.plot.ensemble import fitted_values as fitted_values, mean_curves as mean_curves
    from roughcontact.plot.flows.conductance_plot import conductance_curve as conductance_curve
    from roughcontact.plot.flows.flux_plot import flux_map as flux_map, spot_resistances as spot_resistances
    from roughcontact.plot.flows.gap_flow_map import flow_map as flow_map
    from roughcontact.plot.flows.leak_plot import leak_curve as leak_curve
    from roughcontact.plot.joints.inference_plot import joint_inference as joint_inference
    from roughcontact.plot.joints.joint_maps import joint_figure as joint_figure
    from roughcontact.plot.jumps import (
        jump_area as jump_area,
        jump_figure as jump_figure,
        jump_loop as jump_loop,
    )
    from roughcontact.plot.loops import (
        bearing_curves as bearing_curves,
        depth_loop as depth_loop,
        flattened_figure as flattened_figure,
        loop_figure as loop_figure,
        stiffness_loop as stiffness_loop,
    )
    from roughcontact.plot.maps import (
        contact_map as contact_map,
        height_map as height_map,
        pressure_map as pressure_map,
    )
    from roughcontact.plot.measured_plot import combined_spectrum as combined_spectrum
    from roughcontact.plot.profile_plot import (
        contact_profile as contact_profile,
        pressure_profile as pressure_profile,
        profile_curve as profile_curve,
    )
    from roughcontact.plot.shear_pictures import shear_figure as shear_figure
    from roughcontact.plot.shear_plot import shear_loop as shear_loop
    from roughcontact.plot.sliding_plot import friction_speeds as friction_speeds
    from roughcontact.plot.spectrum_plot import spectrum_curve as spectrum_curve
    from roughcontact.plot.stress_map import von_mises_section as von_mises_section
    from roughcontact.plot.study_picture import study_figure as study_figure
    from roughcontact.plot.tension import (
        state_figure as state_figure,
        tension_map as tension_map,
        tension_profile as tension_profile,
    )
    from roughcontact.plot.view import surface_view as surface_view

__all__ = [name for name in _LATE or globals() if not name.startswith("_")]


if not TYPE_CHECKING:  # a type checker would accept every name of a module with __getattr__

    def __getattr__(name: str) -> Any:
        return open_name(globals(), _LATE, name)


def __dir__() -> list[str]:
    return __all__
