"""Methods in separate files, by which surfaces and solutions are prepared, drawn, tabulated and written.

A class takes them from here, ``plot = methods.plot_curve``, without an import of their files, which import the class.
Type checkers, editors and bundlers of programs read the imports below. At run time each name is a `LateMethod`, which
imports its file when the method is looked up. Only this file has imports that would close a circle.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughcontact.late import LateMethod

if TYPE_CHECKING:
    from roughcontact.adhesion.adhesive_curve_dataset import (
        adhesive_curve_dataset as adhesive_curve_dataset,
        adhesive_curve_record as adhesive_curve_record,
    )
    from roughcontact.adhesion.detachment_dataset import (
        detachment_curve_dataset as detachment_curve_dataset,
        detachment_curve_record as detachment_curve_record,
        detachment_state_dataset as detachment_state_dataset,
        detachment_state_record as detachment_state_record,
    )
    from roughcontact.adhesion.state_dataset import (
        state_dataset as state_dataset,
        state_record as state_record,
    )
    from roughcontact.contact.compare import compare as compare
    from roughcontact.contact.dataset import (
        curve_dataframe as curve_dataframe,
        curve_dataset as curve_dataset,
        curve_record as curve_record,
        solution_dataset as solution_dataset,
        solution_record as solution_record,
    )
    from roughcontact.contact.histograms import (
        gap_histogram as gap_histogram,
        pressure_histogram as pressure_histogram,
    )
    from roughcontact.contact.loop_dataset import loop_dataset as loop_dataset, loop_record as loop_record
    from roughcontact.contact.notes.curve_notes import (
        curve_doubts as curve_doubts,
        curve_notes as curve_notes,
    )
    from roughcontact.contact.notes.solution_notes import notes_on as notes_on
    from roughcontact.evaluation.flux_dataset import (
        flux_dataframe as flux_dataframe,
        flux_dataset as flux_dataset,
    )
    from roughcontact.evaluation.interface_dataset import interface_dataset as interface_dataset
    from roughcontact.files.kept_arrays import keep_arrays as keep_arrays, kept_arrays as kept_arrays
    from roughcontact.files.save import csv_of as csv_of
    from roughcontact.files.surface_dataset import (
        surface_dataset as surface_dataset,
        surface_of as surface_of,
    )
    from roughcontact.fluid.conductance_parts import notes_on_heat_curve as notes_on_heat_curve
    from roughcontact.fluid.flow_notes import (
        notes_on_flow as notes_on_flow,
        notes_on_flow_curve as notes_on_flow_curve,
        notes_on_leak as notes_on_leak,
    )
    from roughcontact.fluid.leak_dataset import (
        flow_dataset as flow_dataset,
        flow_record as flow_record,
    )
    from roughcontact.friction.slip_dataset import (
        slip_curve_dataset as slip_curve_dataset,
        slip_curve_record as slip_curve_record,
        tangential_dataset as tangential_dataset,
        tangential_record as tangential_record,
    )
    from roughcontact.gradients.parameters import (
        to_hardness as to_hardness,
        to_load as to_load,
        to_modulus as to_modulus,
        to_radius as to_radius,
        to_rms_height as to_rms_height,
        to_tilt as to_tilt,
    )
    from roughcontact.joints.joint_dataset import joint_dataset as joint_dataset, joint_record as joint_record
    from roughcontact.joints.pressure_levels import shear_history as shear_history
    from roughcontact.joints.reduced_laws import (
        iwan_distribution as iwan_distribution,
        jenkins_elements as jenkins_elements,
    )
    from roughcontact.measurement.inference_dataset import (
        inference_dataset as inference_dataset,
        inference_record as inference_record,
        plan_dataset as plan_dataset,
    )
    from roughcontact.plot.answers import (
        plot_curve as plot_curve,
        plot_flow as plot_flow,
        plot_flux as plot_flux,
        plot_loop as plot_loop,
        plot_solution as plot_solution,
        plot_state as plot_state,
        plot_surface as plot_surface,
    )
    from roughcontact.plot.creep_plot import creep_curve as creep_curve
    from roughcontact.plot.detachment_plot import detachment_force as detachment_force
    from roughcontact.plot.joints.inference_plot import joint_inference as joint_inference
    from roughcontact.plot.jumps import jump_loop as jump_loop
    from roughcontact.plot.notebook import (
        adhesive_curve_html as adhesive_curve_html,
        curve_html as curve_html,
        detachment_html as detachment_html,
        loop_html as loop_html,
        solution_html as solution_html,
        state_html as state_html,
        surface_html as surface_html,
    )
    from roughcontact.plot.shear_plot import shear_loop as shear_loop
    from roughcontact.plot.sliding_plot import friction_speeds as friction_speeds
    from roughcontact.recipe.in_time.material_file import (
        read_material as read_material,
        write_material as write_material,
    )
    from roughcontact.surface.preparation.alignment import aligned as aligned
    from roughcontact.surface.preparation.despike import despiked as despiked
    from roughcontact.surface.preparation.filters import filtered as filtered
    from roughcontact.surface.preparation.levelling import levelled as levelled, without_form as without_form
    from roughcontact.surface.preparation.mask import masked as masked
    from roughcontact.surface.preparation.missing import filled as filled
    from roughcontact.surface.preparation.orientation import (
        flipped as flipped,
        rotated as rotated,
        transposed as transposed,
    )
    from roughcontact.surface.preparation.sampling import (
        averaged as averaged,
        cropped as cropped,
        downsampled as downsampled,
    )
    from roughcontact.surface.preparation.tip import scanned as scanned
    from roughcontact.surface.preparation.windows import tapered as tapered
    from roughcontact.viscoelastic.curve_dataset import (
        viscoelastic_dataset as viscoelastic_dataset,
        viscoelastic_record as viscoelastic_record,
    )
    from roughcontact.viscoelastic.sliding_dataset import (
        friction_dataset as friction_dataset,
        friction_record as friction_record,
        sliding_dataset as sliding_dataset,
    )
else:
    _HOMES = {
        "adhesion.adhesive_curve_dataset": "adhesive_curve_dataset adhesive_curve_record",
        "adhesion.detachment_dataset": (
            "detachment_curve_dataset detachment_curve_record "
            "detachment_state_dataset detachment_state_record"
        ),
        "adhesion.state_dataset": "state_dataset state_record",
        "contact.compare": "compare",
        "contact.notes.curve_notes": "curve_doubts curve_notes",
        "contact.dataset": ("curve_dataframe curve_dataset curve_record solution_dataset solution_record"),
        "contact.histograms": "gap_histogram pressure_histogram",
        "contact.loop_dataset": "loop_dataset loop_record",
        "contact.notes.solution_notes": "notes_on",
        "evaluation.flux_dataset": "flux_dataframe flux_dataset",
        "evaluation.interface_dataset": "interface_dataset",
        "gradients.parameters": "to_hardness to_load to_modulus to_radius to_rms_height to_tilt",
        "files.kept_arrays": "keep_arrays kept_arrays",
        "files.save": "csv_of",
        "files.surface_dataset": "surface_dataset surface_of",
        "fluid.leak_dataset": "flow_dataset flow_record",
        "fluid.conductance_parts": "notes_on_heat_curve",
        "fluid.flow_notes": "notes_on_flow notes_on_flow_curve notes_on_leak",
        "friction.slip_dataset": "slip_curve_dataset slip_curve_record tangential_dataset tangential_record",
        "joints.joint_dataset": "joint_dataset joint_record",
        "joints.pressure_levels": "shear_history",
        "joints.reduced_laws": "iwan_distribution jenkins_elements",
        "measurement.inference_dataset": "inference_dataset inference_record plan_dataset",
        "plot.answers": "plot_curve plot_flow plot_flux plot_loop plot_solution plot_state plot_surface",
        "plot.creep_plot": "creep_curve",
        "plot.detachment_plot": "detachment_force",
        "plot.shear_plot": "shear_loop",
        "plot.sliding_plot": "friction_speeds",
        "plot.joints.inference_plot": "joint_inference",
        "plot.jumps": "jump_loop",
        "plot.notebook": (
            "adhesive_curve_html curve_html detachment_html loop_html solution_html state_html surface_html"
        ),
        "recipe.in_time.material_file": "read_material write_material",
        "surface.preparation.filters": "filtered",
        "surface.preparation.levelling": "levelled without_form",
        "surface.preparation.mask": "masked",
        "surface.preparation.missing": "filled",
        "surface.preparation.orientation": "flipped rotated transposed",
        "surface.preparation.sampling": "averaged cropped downsampled",
        "surface.preparation.alignment": "aligned",
        "surface.preparation.despike": "despiked",
        "surface.preparation.tip": "scanned",
        "surface.preparation.windows": "tapered",
        "viscoelastic.curve_dataset": "viscoelastic_dataset viscoelastic_record",
        "viscoelastic.sliding_dataset": "friction_dataset friction_record sliding_dataset",
    }
    for _home, _names in _HOMES.items():
        globals().update({name: LateMethod(f"roughcontact.{_home}", name) for name in _names.split()})
