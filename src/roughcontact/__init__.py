"""Elastic contact of rough surfaces: certified pressure, area, stiffness and depth against load.

Get a surface: `read`, `Surface`, `self_affine`, `specified`, `shapes`, `examples`; `read_line` for a profile. Its
methods prepare it, such as ``surface.levelled("plane")``. Bodies: `handbook`, `Solid`, `reduced_modulus`.

Press it: `press` for one load, `loading_curve` for many, `loading_loop` up and down; `adhesive_curve` if surfaces
attract each other, `slide` under a tangential force. `conductance`, `error_budget` and `below` evaluate the result;
`citations` lists the papers behind it.

Subpackages: `theory` (laws to compare with), `plot`, `study` (ensembles), `statistics`, `mdr`, `viscoelastic`.
``help(rc.press)`` shows one name; the command ``roughcontact doctor`` checks an installation.
"""

from __future__ import annotations

import sys

if sys.orig_argv[1:3] == ["-m", "roughcontact"] or "".join(sys.orig_argv[1:2]).removesuffix(".exe").endswith(
    ("/roughcontact", "\\roughcontact")
):
    # The command line: the imports below take a tenth of a second.
    from roughcontact.quiet_start import start_quietly

    start_quietly()

from typing import TYPE_CHECKING, Any

from roughcontact.late import late_names, open_name
from roughcontact.version import __version__

# Type checkers and bundlers of programs read the block below; at run time each name is imported on first access.
_LATE = late_names(__spec__)
if TYPE_CHECKING or _LATE is None:
    from roughcontact import (
        mdr as mdr,
        plot as plot,
        progress as progress,
        statistics as statistics,
        study as study,
        theory as theory,
        viscoelastic as viscoelastic,
    )
    from roughcontact.adhesion.adhesive_curve import (
        AdhesiveCurve as AdhesiveCurve,
        AdhesivePoint as AdhesivePoint,
    )
    from roughcontact.adhesion.adhesive_loading import (
        adhesive_curve as adhesive_curve,
        adhesive_path as adhesive_path,
        adhesive_state as adhesive_state,
    )
    from roughcontact.adhesion.adhesive_loop import adhesive_loop as adhesive_loop
    from roughcontact.adhesion.adhesive_state import AdhesiveState as AdhesiveState
    from roughcontact.adhesion.attraction import Adhesion as Adhesion
    from roughcontact.adhesion.detachment import Detachment as Detachment
    from roughcontact.adhesion.detachment_curve import (
        DetachmentCurve as DetachmentCurve,
        detachment_curve as detachment_curve,
    )
    from roughcontact.adhesion.detachment_path import detachment_path as detachment_path
    from roughcontact.adhesion.detachment_state import DetachmentState as DetachmentState
    from roughcontact.adhesion.quasi_static import Jump as Jump
    from roughcontact.citing.bibliography import Citations as Citations
    from roughcontact.citing.citations import citations as citations
    from roughcontact.contact.compare import Comparison as Comparison
    from roughcontact.contact.convergence import ConvergenceError as ConvergenceError
    from roughcontact.contact.curve import Curve as Curve
    from roughcontact.contact.curve_record import CurvePoint as CurvePoint
    from roughcontact.contact.flow import Flow as Flow
    from roughcontact.contact.flow_curve import FlowCurve as FlowCurve
    from roughcontact.contact.loading import loading_curve as loading_curve, loading_path as loading_path
    from roughcontact.contact.loads.load_range import load_range as load_range
    from roughcontact.contact.loop import Loop as Loop, loading_loop as loading_loop
    from roughcontact.contact.memory_needed import memory_needed as memory_needed
    from roughcontact.contact.press import press as press
    from roughcontact.contact.problem import ContactProblem as ContactProblem
    from roughcontact.contact.size_law import NixGao as NixGao
    from roughcontact.contact.solution import Solution as Solution
    from roughcontact.contact.stiffness import contact_stiffness as contact_stiffness
    from roughcontact.errors import InputError as InputError
    from roughcontact.evaluation.below import (
        StressPeak as StressPeak,
        below as below,
        displacement_below as displacement_below,
        largest_von_mises as largest_von_mises,
    )
    from roughcontact.evaluation.conduction import conductance as conductance
    from roughcontact.evaluation.contact_flux import ContactFlux as ContactFlux, contact_flux as contact_flux
    from roughcontact.evaluation.error_sources import error_budget as error_budget
    from roughcontact.evaluation.interface_table import (
        InterfaceTable as InterfaceTable,
        interface_table as interface_table,
    )
    from roughcontact.evaluation.noise import Noise as Noise
    from roughcontact.evaluation.reflection import reflection as reflection
    from roughcontact.evaluation.theories import loading_laws as loading_laws
    from roughcontact.evaluation.theory_table import theory_table as theory_table
    from roughcontact.files.aside import WriteError as WriteError
    from roughcontact.files.file_errors import ReadError as ReadError, SurfaceWarning as SurfaceWarning
    from roughcontact.files.measured.read_joint_table import (
        JointTable as JointTable,
        read_joint_table as read_joint_table,
    )
    from roughcontact.files.measured.read_measurements import read_measurements as read_measurements
    from roughcontact.files.read import read as read, read_line as read_line
    from roughcontact.files.read_adhesive_curve import read_adhesive_curve as read_adhesive_curve
    from roughcontact.files.read_curve import read_curve as read_curve
    from roughcontact.files.read_detachment_curve import read_detachment_curve as read_detachment_curve
    from roughcontact.files.read_pressure_field import read_pressure_field as read_pressure_field
    from roughcontact.files.save import write as write
    from roughcontact.fluid.conductance_parts import ConductanceParts as ConductanceParts
    from roughcontact.fluid.fluids import Gas as Gas, Liquid as Liquid
    from roughcontact.fluid.gap_flow import GapFlow as GapFlow, gap_flow as gap_flow
    from roughcontact.fluid.joint_conductance import (
        JointConductance as JointConductance,
        joint_conductance as joint_conductance,
    )
    from roughcontact.fluid.leak import Leak as Leak, leak as leak
    from roughcontact.fluid.sealing_load import SealingLoad as SealingLoad, sealing_load as sealing_load
    from roughcontact.fluid.transmissivity import Transmissivity as Transmissivity, leak_rates as leak_rates
    from roughcontact.friction.slide import load_cycle as load_cycle, slide as slide, slide_path as slide_path
    from roughcontact.friction.slip_curve import SlipCurve as SlipCurve, slide_curve as slide_curve
    from roughcontact.friction.slip_solution import TangentialSolution as TangentialSolution
    from roughcontact.friction.tangential_stiffness import (
        TangentialStiffness as TangentialStiffness,
        tangential_stiffness as tangential_stiffness,
    )
    from roughcontact.gradients.derivatives import Sensitivity as Sensitivity
    from roughcontact.gradients.differentiable import (
        CurveValues as CurveValues,
        DifferentiableCurve as DifferentiableCurve,
        differentiable_curve as differentiable_curve,
    )
    from roughcontact.gradients.sensitivity import sensitivity as sensitivity
    from roughcontact.grid import Grid as Grid, RadialGrid as RadialGrid
    from roughcontact.halfspace.operators.build import (
        half_space as half_space,
        ring as ring,
        singly_periodic as singly_periodic,
    )
    from roughcontact.halfspace.operators.check_operator import (
        OperatorCheck as OperatorCheck,
        check_operator as check_operator,
    )
    from roughcontact.halfspace.operators.geometry import Geometry as Geometry
    from roughcontact.halfspace.operators.layer import layer as layer
    from roughcontact.halfspace.operators.line_contact import line as line
    from roughcontact.halfspace.operators.nodal_flexibility import nodal_flexibility as nodal_flexibility
    from roughcontact.halfspace.operators.operator import Capabilities as Capabilities, Operator as Operator
    from roughcontact.halfspace.shear.shear_operator import (
        ShearOperator as ShearOperator,
        shear_half_space as shear_half_space,
    )
    from roughcontact.halfspace.subsurface.fields_below import Displacement as Displacement, Stress as Stress
    from roughcontact.joints.bolt_pressure import bolt_pressure as bolt_pressure
    from roughcontact.joints.cycle_heat import cycle_heat as cycle_heat
    from roughcontact.joints.joint_leak import joint_leak as joint_leak
    from roughcontact.joints.masing import ShearCycle as ShearCycle
    from roughcontact.joints.normal_law import NormalLaw as NormalLaw, normal_law as normal_law
    from roughcontact.joints.pressure_field import PressureField as PressureField
    from roughcontact.joints.pressure_levels import ShearHistory as ShearHistory, ShearLevels as ShearLevels
    from roughcontact.joints.reduced_laws import JenkinsElements as JenkinsElements
    from roughcontact.joints.shear_dataset import shear_dataset as shear_dataset
    from roughcontact.joints.shear_law import ShearLaw as ShearLaw, shear_law as shear_law
    from roughcontact.joints.slip_cycle import SlipCycle as SlipCycle, shear_cycle as shear_cycle
    from roughcontact.joints.whole_joint import Joint as Joint, joint as joint
    from roughcontact.material import Solid as Solid
    from roughcontact.materials import (
        Material as Material,
        handbook as handbook,
        reduced_modulus as reduced_modulus,
        reduced_shear_modulus as reduced_shear_modulus,
    )
    from roughcontact.mdr.foundation import foundation as foundation
    from roughcontact.measurement.combined_spectrum import CombinedSpectrum as CombinedSpectrum
    from roughcontact.measurement.infer_joint import infer_joint as infer_joint
    from roughcontact.measurement.instrument import Instrument as Instrument
    from roughcontact.measurement.joint_data import (
        JointClosures as JointClosures,
        JointStiffness as JointStiffness,
    )
    from roughcontact.measurement.joint_inference import JointInference as JointInference
    from roughcontact.measurement.joint_plan import JointPlan as JointPlan, plan_joint as plan_joint
    from roughcontact.measurement.joint_topography import JointTopography as JointTopography
    from roughcontact.measurement.line_spectrum import (
        LineSpectra as LineSpectra,
        line_spectra as line_spectra,
    )
    from roughcontact.measurement.measurement import Measurement as Measurement
    from roughcontact.measurement.measurements import Measurements as Measurements
    from roughcontact.measurement.press_draws import PressedDraws as PressedDraws, press_draws as press_draws
    from roughcontact.memory import MemoryWarning as MemoryWarning
    from roughcontact.slabs.slabs import Slabs as Slabs
    from roughcontact.solver.active_set import ActiveSet as ActiveSet
    from roughcontact.solver.control import Depth as Depth, Force as Force, Status as Status
    from roughcontact.solver.polonsky_keer import PolonskyKeer as PolonskyKeer
    from roughcontact.solver.prescribed import prescribed_displacement as prescribed_displacement
    from roughcontact.statistics.power_law import PowerLaw as PowerLaw
    from roughcontact.study.press_many import press_many as press_many
    from roughcontact.surface.analysis.correlation import (
        autocorrelation as autocorrelation,
        structure_function as structure_function,
        structure_profile as structure_profile,
    )
    from roughcontact.surface.analysis.cut import (
        cut_factor as cut_factor,
        profile_spectrum as profile_spectrum,
        surface_spectrum as surface_spectrum,
    )
    from roughcontact.surface.analysis.histogram import height_histogram as height_histogram
    from roughcontact.surface.analysis.hurst import (
        HurstFit as HurstFit,
        fit_spectrum as fit_spectrum,
        hurst_exponent as hurst_exponent,
    )
    from roughcontact.surface.analysis.merge import (
        merge_spectra as merge_spectra,
        spectra_ratio as spectra_ratio,
    )
    from roughcontact.surface.analysis.power import PowerSpectrum as PowerSpectrum
    from roughcontact.surface.analysis.power_map import PowerMap as PowerMap, power_map as power_map
    from roughcontact.surface.analysis.spectra import power_spectrum as power_spectrum
    from roughcontact.surface.analysis.spectrum_moments import spectrum_moments as spectrum_moments
    from roughcontact.surface.analysis.structure_fit import fit_structure as fit_structure
    from roughcontact.surface.analysis.summits import find_summits as find_summits
    from roughcontact.surface.fractal import (
        box_counting_dimension as box_counting_dimension,
        fractal_dimension as fractal_dimension,
        magnify as magnify,
    )
    from roughcontact.surface.generation import examples as examples, shapes as shapes
    from roughcontact.surface.generation.fourier import self_affine as self_affine, synthesise as synthesise
    from roughcontact.surface.generation.midpoint import (
        midpoint_line as midpoint_line,
        midpoint_surface as midpoint_surface,
    )
    from roughcontact.surface.generation.specification import (
        SurfaceSpecification as SurfaceSpecification,
        specified as specified,
    )
    from roughcontact.surface.generation.spectrum import (
        DirectionalSpectrum as DirectionalSpectrum,
        SelfAffineSpectrum as SelfAffineSpectrum,
        StretchedSpectrum as StretchedSpectrum,
    )
    from roughcontact.surface.moments import (
        Moments as Moments,
        grid_moments as grid_moments,
        surface_moments as surface_moments,
    )
    from roughcontact.surface.parameters.areal import areal_parameters as areal_parameters
    from roughcontact.surface.parameters.material_ratio import (
        material_ratio as material_ratio,
        stratified_parameters as stratified_parameters,
    )
    from roughcontact.surface.parameters.profile import profile_parameters as profile_parameters
    from roughcontact.surface.preparation.combine import combined as combined, resampled as resampled
    from roughcontact.surface.preparation.shift import MapShift as MapShift, shift_between as shift_between
    from roughcontact.surface.preparation.spikes import Spikes as Spikes, find_spikes as find_spikes
    from roughcontact.surface.radial import RadialProfile as RadialProfile
    from roughcontact.surface.surface import Surface as Surface
    from roughcontact.viscoelastic.friction_curve import (
        FrictionCurve as FrictionCurve,
        friction_curve as friction_curve,
    )
    from roughcontact.viscoelastic.prony_series import Viscoelastic as Viscoelastic
    from roughcontact.viscoelastic.steady_sliding import (
        SlidingContact as SlidingContact,
        steady_sliding as steady_sliding,
    )
    from roughcontact.viscoelastic.viscoelastic_curve import ViscoelasticCurve as ViscoelasticCurve
    from roughcontact.viscoelastic.viscoelastic_loading import (
        viscoelastic_curve as viscoelastic_curve,
        viscoelastic_path as viscoelastic_path,
    )
    from roughcontact.viscoelastic.viscoelastic_state import ViscoelasticState as ViscoelasticState

__all__ = ["__version__", *(_LATE or (name for name in globals() if not name.startswith("_")))]


if not TYPE_CHECKING:  # a type checker would accept every name of a module with __getattr__

    def __getattr__(name: str) -> Any:
        return open_name(globals(), _LATE, name)


def __dir__() -> list[str]:
    return sorted(__all__)
