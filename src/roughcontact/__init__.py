"""Elastic contact of rough surfaces: certified pressure, area, stiffness and depth against load."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from roughcontact.threads import no_fork

__version__ = "0.1.0"

# The public names and the rooms they live in; a room is opened when its name is first asked for.
_ROOMS = {
    "Grid": "grid",
    "RadialGrid": "grid",
    "Solid": "material",
    "reduced_modulus": "material",
    "reduced_shear_modulus": "material",
    "Surface": "surface.surface",
    "RadialProfile": "surface.radial",
    "self_affine": "surface.fourier",
    "SelfAffineSpectrum": "surface.spectrum",
    "synthesise": "surface.fourier",
    "StretchedSpectrum": "surface.spectrum",
    "DirectionalSpectrum": "surface.spectrum",
    "Moments": "surface.moments",
    "grid_moments": "surface.moments",
    "surface_moments": "surface.moments",
    "midpoint_line": "surface.midpoint",
    "midpoint_surface": "surface.midpoint",
    "magnify": "surface.fractal",
    "fractal_dimension": "surface.fractal",
    "box_counting_dimension": "surface.fractal",
    "combined": "surface.combine",
    "resampled": "surface.combine",
    "PowerSpectrum": "surface.analysis.power",
    "power_spectrum": "surface.analysis.spectra",
    "PowerMap": "surface.analysis.power_map",
    "power_map": "surface.analysis.power_map",
    "HurstFit": "surface.analysis.hurst",
    "hurst_exponent": "surface.analysis.hurst",
    "fit_spectrum": "surface.analysis.hurst",
    "fit_structure": "surface.analysis.structure_fit",
    "merge_spectra": "surface.analysis.merge",
    "spectra_ratio": "surface.analysis.merge",
    "surface_spectrum": "surface.analysis.cut",
    "profile_spectrum": "surface.analysis.cut",
    "cut_factor": "surface.analysis.cut",
    "autocorrelation": "surface.analysis.correlation",
    "structure_function": "surface.analysis.correlation",
    "structure_profile": "surface.analysis.correlation",
    "height_histogram": "surface.analysis.histogram",
    "spectrum_moments": "surface.analysis.spectrum_moments",
    "find_summits": "surface.analysis.summits",
    "areal_parameters": "surface.parameters.areal",
    "profile_parameters": "surface.parameters.profile",
    "material_ratio": "surface.parameters.material_ratio",
    "stratified_parameters": "surface.parameters.material_ratio",
    "half_space": "halfspace.operators.build",
    "ring": "halfspace.operators.build",
    "singly_periodic": "halfspace.operators.build",
    "layer": "halfspace.operators.layer",
    "Stress": "halfspace.subsurface.fields_below",
    "Displacement": "halfspace.subsurface.fields_below",
    "below": "contact.below",
    "displacement_below": "contact.below",
    "largest_von_mises": "contact.below",
    "StressPeak": "contact.below",
    "line": "halfspace.operators.line_contact",
    "foundation": "mdr.foundation",
    "ShearOperator": "halfspace.shear.shear_operator",
    "shear_half_space": "halfspace.shear.shear_operator",
    "TangentialSolution": "friction.slip_solution",
    "TangentialStiffness": "friction.tangential_stiffness",
    "tangential_stiffness": "friction.tangential_stiffness",
    "slide": "friction.slide",
    "slide_path": "friction.slide",
    "load_cycle": "friction.slide",
    "SlipCurve": "friction.slip_curve",
    "slide_curve": "friction.slip_curve",
    "Geometry": "halfspace.operators.geometry",
    "Operator": "halfspace.operators.operator",
    "Capabilities": "halfspace.operators.operator",
    "Force": "solver.control",
    "Depth": "solver.control",
    "ContactProblem": "contact.problem",
    "Solution": "contact.solution",
    "Status": "solver.control",
    "ConvergenceError": "contact.convergence",
    "ActiveSet": "solver.active_set",
    "PolonskyKeer": "solver.polonsky_keer",
    "press": "contact.press",
    "contact_stiffness": "contact.stiffness",
    "prescribed_displacement": "solver.prescribed",
    "loading_path": "contact.loading",
    "loading_curve": "contact.loading",
    "suggested_forces": "contact.loading",
    "Curve": "contact.curve",
    "Comparison": "contact.compare",
    "conductance": "contact.conduction",
    "loading_laws": "contact.theories",
    "PowerLaw": "statistics.power_law",
    "read": "files.read",
    "read_line": "files.read",
    "read_curve": "files.read_curve",
    "write": "files.save",
    "WriteError": "files.aside",
    "SurfaceWarning": "files.file_errors",
    "ReadError": "files.file_errors",
}

# Public names that are modules themselves.
_MODULES = {
    "shapes": "surface.shapes",
    "statistics": "statistics",
    "theory": "theory",
    "mdr": "mdr",
    "study": "study",
}

__all__ = ["__version__", *_ROOMS, *_MODULES]

if TYPE_CHECKING:
    from roughcontact import mdr as mdr
    from roughcontact import statistics as statistics
    from roughcontact import study as study
    from roughcontact import theory as theory
    from roughcontact.contact.below import StressPeak as StressPeak
    from roughcontact.contact.below import below as below
    from roughcontact.contact.below import displacement_below as displacement_below
    from roughcontact.contact.below import largest_von_mises as largest_von_mises
    from roughcontact.contact.compare import Comparison as Comparison
    from roughcontact.contact.conduction import conductance as conductance
    from roughcontact.contact.convergence import ConvergenceError as ConvergenceError
    from roughcontact.contact.curve import Curve as Curve
    from roughcontact.contact.loading import loading_curve as loading_curve
    from roughcontact.contact.loading import loading_path as loading_path
    from roughcontact.contact.loading import suggested_forces as suggested_forces
    from roughcontact.contact.press import press as press
    from roughcontact.contact.problem import ContactProblem as ContactProblem
    from roughcontact.contact.solution import Solution as Solution
    from roughcontact.contact.stiffness import contact_stiffness as contact_stiffness
    from roughcontact.contact.theories import loading_laws as loading_laws
    from roughcontact.files.aside import WriteError as WriteError
    from roughcontact.files.file_errors import ReadError as ReadError
    from roughcontact.files.file_errors import SurfaceWarning as SurfaceWarning
    from roughcontact.files.read import read as read
    from roughcontact.files.read import read_line as read_line
    from roughcontact.files.read_curve import read_curve as read_curve
    from roughcontact.files.save import write as write
    from roughcontact.friction.slide import load_cycle as load_cycle
    from roughcontact.friction.slide import slide as slide
    from roughcontact.friction.slide import slide_path as slide_path
    from roughcontact.friction.slip_curve import SlipCurve as SlipCurve
    from roughcontact.friction.slip_curve import slide_curve as slide_curve
    from roughcontact.friction.slip_solution import TangentialSolution as TangentialSolution
    from roughcontact.friction.tangential_stiffness import TangentialStiffness as TangentialStiffness
    from roughcontact.friction.tangential_stiffness import tangential_stiffness as tangential_stiffness
    from roughcontact.grid import Grid as Grid
    from roughcontact.grid import RadialGrid as RadialGrid
    from roughcontact.halfspace.operators.build import half_space as half_space
    from roughcontact.halfspace.operators.build import ring as ring
    from roughcontact.halfspace.operators.build import singly_periodic as singly_periodic
    from roughcontact.halfspace.operators.geometry import Geometry as Geometry
    from roughcontact.halfspace.operators.layer import layer as layer
    from roughcontact.halfspace.operators.line_contact import line as line
    from roughcontact.halfspace.operators.operator import Capabilities as Capabilities
    from roughcontact.halfspace.operators.operator import Operator as Operator
    from roughcontact.halfspace.shear.shear_operator import ShearOperator as ShearOperator
    from roughcontact.halfspace.shear.shear_operator import shear_half_space as shear_half_space
    from roughcontact.halfspace.subsurface.fields_below import Displacement as Displacement
    from roughcontact.halfspace.subsurface.fields_below import Stress as Stress
    from roughcontact.material import Solid as Solid
    from roughcontact.material import reduced_modulus as reduced_modulus
    from roughcontact.material import reduced_shear_modulus as reduced_shear_modulus
    from roughcontact.mdr.foundation import foundation as foundation
    from roughcontact.solver.active_set import ActiveSet as ActiveSet
    from roughcontact.solver.control import Depth as Depth
    from roughcontact.solver.control import Force as Force
    from roughcontact.solver.control import Status as Status
    from roughcontact.solver.polonsky_keer import PolonskyKeer as PolonskyKeer
    from roughcontact.solver.prescribed import prescribed_displacement as prescribed_displacement
    from roughcontact.statistics.power_law import PowerLaw as PowerLaw
    from roughcontact.surface import shapes as shapes
    from roughcontact.surface.analysis.correlation import autocorrelation as autocorrelation
    from roughcontact.surface.analysis.correlation import structure_function as structure_function
    from roughcontact.surface.analysis.correlation import structure_profile as structure_profile
    from roughcontact.surface.analysis.cut import cut_factor as cut_factor
    from roughcontact.surface.analysis.cut import profile_spectrum as profile_spectrum
    from roughcontact.surface.analysis.cut import surface_spectrum as surface_spectrum
    from roughcontact.surface.analysis.histogram import height_histogram as height_histogram
    from roughcontact.surface.analysis.hurst import HurstFit as HurstFit
    from roughcontact.surface.analysis.hurst import fit_spectrum as fit_spectrum
    from roughcontact.surface.analysis.hurst import hurst_exponent as hurst_exponent
    from roughcontact.surface.analysis.merge import merge_spectra as merge_spectra
    from roughcontact.surface.analysis.merge import spectra_ratio as spectra_ratio
    from roughcontact.surface.analysis.power import PowerSpectrum as PowerSpectrum
    from roughcontact.surface.analysis.power_map import PowerMap as PowerMap
    from roughcontact.surface.analysis.power_map import power_map as power_map
    from roughcontact.surface.analysis.spectra import power_spectrum as power_spectrum
    from roughcontact.surface.analysis.spectrum_moments import spectrum_moments as spectrum_moments
    from roughcontact.surface.analysis.structure_fit import fit_structure as fit_structure
    from roughcontact.surface.analysis.summits import find_summits as find_summits
    from roughcontact.surface.combine import combined as combined
    from roughcontact.surface.combine import resampled as resampled
    from roughcontact.surface.fourier import self_affine as self_affine
    from roughcontact.surface.fourier import synthesise as synthesise
    from roughcontact.surface.fractal import box_counting_dimension as box_counting_dimension
    from roughcontact.surface.fractal import fractal_dimension as fractal_dimension
    from roughcontact.surface.fractal import magnify as magnify
    from roughcontact.surface.midpoint import midpoint_line as midpoint_line
    from roughcontact.surface.midpoint import midpoint_surface as midpoint_surface
    from roughcontact.surface.moments import Moments as Moments
    from roughcontact.surface.moments import grid_moments as grid_moments
    from roughcontact.surface.moments import surface_moments as surface_moments
    from roughcontact.surface.parameters.areal import areal_parameters as areal_parameters
    from roughcontact.surface.parameters.material_ratio import material_ratio as material_ratio
    from roughcontact.surface.parameters.material_ratio import stratified_parameters as stratified_parameters
    from roughcontact.surface.parameters.profile import profile_parameters as profile_parameters
    from roughcontact.surface.radial import RadialProfile as RadialProfile
    from roughcontact.surface.spectrum import DirectionalSpectrum as DirectionalSpectrum
    from roughcontact.surface.spectrum import SelfAffineSpectrum as SelfAffineSpectrum
    from roughcontact.surface.spectrum import StretchedSpectrum as StretchedSpectrum
    from roughcontact.surface.surface import Surface as Surface


def __getattr__(name: str) -> Any:
    with no_fork:  # a process forked in the middle of an import could never import the same
        if name in _MODULES:
            return import_module(f"roughcontact.{_MODULES[name]}")
        if name not in _ROOMS:
            raise AttributeError(f"module 'roughcontact' has no attribute {name!r}")
        value = getattr(import_module(f"roughcontact.{_ROOMS[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
