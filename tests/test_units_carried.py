"""Values that carry a unit: each parameter of each public function converts them, or refuses them by its name."""

import inspect
import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import cache

import numpy as np
import pint
import pytest
import xarray

import roughcontact as rc
from public_names import _never_called, _parsed, public_names
from test_bad_input import (
    CALLS,
    CUT,
    FREE,
    LAW,
    MASK,
    PERIODIC,
    PRESSED,
    RING,
    ROUGH,
    SCAN,
    SOFT as SOFT_MATERIAL,
    SPECTRUM,
    STEEL,
    STICKY as STICKY_TIP,
    TIP,
)  # fmt: skip

U = pint.get_application_registry()
SOFT = rc.RadialProfile(-(rc.RadialGrid.uniform(40, 6e-7).radii ** 2) / 2e-5, rc.RadialGrid.uniform(40, 6e-7))
STICKING = {"depth": 0.0, "force": 1e-6, "pressure": 1e3, "mean_gap": 2e-7}
STICKY = rc.Adhesion(work=10e-3, range=4e-9)
STRETCHED = rc.StretchedSpectrum(LAW, 2.0)
DIRECTIONAL = rc.DirectionalSpectrum(lambda qy, qx: 1 / (1 + qy**2 + qx**2))
_BINS = np.geomspace(4e5, 1.6e6, 5)
_TENTHS = np.full(5, 0.1)
MEASURED = rc.CombinedSpectrum(
    *(_BINS, 1e-26 * _BINS / _BINS, "C2D", _TENTHS, _TENTHS, _TENTHS, 90 * _TENTHS, ("map",), _TENTHS[None]),
    *(4e5, 1.6e6, (), ()),
)
BALL = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
JOINT = rc.specified(sigma=1e-6, slope=0.1)
CURVE = rc.loading_curve(BALL, 1e9, forces=np.geomspace(1e-2, 1e-1, 6))
FLOWN = rc.loading_curve(BALL, 1e9, forces=[1e-3], measures=[rc.Transmissivity(axis=0)])
SHEARED = rc.shear_law(rc.loading_curve(ROUGH, STEEL, pressures=[1e5, 2e5, 1e6]), STEEL, friction=0.3)
SMOOTH = SHEARED.fitted
LINE_OPERATOR = rc.line(SCAN.grid, 1e9)
SHAPES = {
    rc.shapes.cone: {"slope": 0.1},
    rc.shapes.cylinder: {"radius": 1e-3},
    rc.shapes.flat_disc: {"radius": 5e-6},
    rc.shapes.flat_ring: {"inner": 2e-6, "outer": 5e-6},
    rc.shapes.flat_square: {"side": 5e-6},
    rc.shapes.flat_triangle: {"side": 5e-6},
    rc.shapes.paraboloid: {"radius": 1e-3},
    rc.shapes.power_law: {"exponent": 2.0, "coefficient": 3.0},
    rc.shapes.sphere: {"radius": 1e-3},
}
_STEELS = (rc.Solid(1e9, 0.3), rc.Solid(1e9, 0.3))
_PRESSURE = rc.PressureField(np.pad(np.full((1, 1), np.nan), 1, constant_values=1e6), 1e-3)
_OF_JOINT = rc.loading_curve(ROUGH, _STEELS, pressures=[1e5, 1e6], measures=[rc.Transmissivity(axis=0)])
LAW_OF_JOINT = rc.shear_law(_OF_JOINT, _STEELS, friction=0.3)
WHOLE_JOINT = rc.joint(LAW_OF_JOINT, _PRESSURE)
_MEASURED = {
    "pressures": np.geomspace(7e6, 1.4e8, 5),
    "stiffness": 1.9e7 * np.geomspace(7e6, 1.4e8, 5) ** 0.88,
}
_OF_MEASURED = {
    "data": rc.JointStiffness(**_MEASURED, errors=0.05),
    "modulus": 1.15e11,
    "modulus_error": 0.02,
    "area": 2e-4,
    "branch": "loading",
}
INFERRED = rc.infer_joint(**_OF_MEASURED)
VISCO = rc.viscoelastic
# What is called beside tests/test_bad_input.py, and good arguments.
_LEAK = {"solution": PRESSED, "fluid": rc.Liquid(1e-3), "axis": 0}
SOFT_STATE = next(rc.viscoelastic_path(ROUGH, SOFT_MATERIAL, times=[0.0], forces=[1e-6], steps=1))
MORE = [
    *(
        (call, {"surface": rc.shapes.wave(rc.Grid((4, 16), 1e-6, periodic=True), 1e-7, 1.6e-5),
                "material": SOFT_MATERIAL} | speed | load)
        for call, speed in ((rc.steady_sliding, {"speed": 1e-6}), (rc.friction_curve, {"speeds": [1e-6]}))
        for load in ({"pressure": 1e6}, {"force": 1e-5})
    ),
    *((shape, {"grid": FREE, "centre": (7e-6, 9e-6)} | good) for shape, good in SHAPES.items()),
    (rc.shapes.wave, {"grid": PERIODIC, "amplitude": 1e-7, "wavelength": 8e-6, "centre": (1e-6, 2e-6)}),
    (rc.JointStiffness, _MEASURED | {"errors": 0.05, "gain": 0.03}),
    (rc.JointStiffness.from_reflection, {"pressures": _MEASURED["pressures"], "reflected": [0.9, 0.8, 0.7, 0.6, 0.5],
                                         "error": 0.01, "frequency": 2e6, "impedances": (46e6, 46e6)}),
    (rc.JointClosures, {"pressures": _MEASURED["pressures"], "closures": np.arange(1.0, 6.0) * 1e-7,
                        "resolution": 1e-8, "compliance": 1e-16, "compliance_error": 1e-17}),
    (rc.JointTopography, {"rms": 1e-6, "rms_error": 0.1, "rolloff": 1e-4, "rolloff_error": 0.3}),
    (rc.infer_joint, _OF_MEASURED | {"hardness": 2e9, "hardness_error": 0.1}),
    *((call, {"pressures": [1e7, 2e7]}) for call in (INFERRED.predicted, INFERRED.predicted_closures)),
    (rc.plan_joint, {"pressures": np.geomspace(7e6, 1.4e8, 5), "errors": 0.05, "gain": 0.03, "modulus": 1.15e11,
                     "modulus_error": 0.02, "areas": np.array([1e-6, 2e-6]),
                     "profile": rc.JointTopography(1.2e-6, 0.5, 1e-4, 0.3)}),
    (INFERRED.share_below, {"height": 1e-6}),
    (rc.PressureField, {"pressure": np.full((2, 3), 1e6), "grid": 1e-3}),
    (rc.bolt_pressure, {"force": 1e3, "head": 13e-3, "hole": 9e-3, "thickness": 1e-2, "half_angle": 0.5}),
    (rc.joint, {"law": LAW_OF_JOINT, "field": _PRESSURE, "longest_wave": 1e-5}),
    (rc.joint_leak, {"joint": WHOLE_JOINT, "fluid": rc.Liquid(1e-3), "drop": 1e3}),
    *((call, {"displacement": 1e-7}) for call in (WHOLE_JOINT.shear_force, WHOLE_JOINT.loss, WHOLE_JOINT.damping)),
    (WHOLE_JOINT.conductance, {"conductivities": (50.0, 50.0), "resistivities": (1e-8, 1e-8)}),
    (rc.Grid, {"shape": (4, 8), "spacing": 1e-6}),
    (rc.Grid, {"shape": (4, 8), "spacing": (1e-6, 2e-6)}),
    (rc.Grid, {"shape": (4, 8), "size": 8e-6}),
    (rc.Surface, {"heights": np.zeros((4, 8)), "grid": 1e-6}),
    (rc.RadialGrid, {"edges": RING.edges}),
    (rc.RadialGrid.uniform, {"rings": 4, "radius": 1e-3}),
    (rc.Surface, {"heights": CUT.heights, "grid": FREE}),
    (rc.RadialProfile, {"heights": np.array([0.0, -1e-6, -2e-6, -3e-6, -4e-6]), "grid": RING}),
    (CUT.with_heights, {"heights": CUT.heights, "line": "again"}),
    (CUT.masked, {"below": -1e-7, "above": 1e-7}),
    (rc.Material, {"name": "m", "grade": "g", "solid": STEEL, "hardness": 1e9, "conductivity": 30.0,
                   "resistivity": 1e-8, "density": 8e3, "sources": {}}),
    (rc.NixGao, {"hardness": 1e9, "radius": 1e-6}),
    (rc.Adhesion, {"work": 50e-3, "range": 2e-9}),
    (STICKY.process_zone, {"modulus": 1e8}),
    (STICKY.tabor, {"radius": 1e-5, "modulus": 1e8}),
    (rc.SelfAffineSpectrum, {"hurst": 0.8, "long_cutoff": 1e-5}),
    (rc.PowerSpectrum, {"wavenumber": SPECTRUM.wavenumber, "density": SPECTRUM.density, "kind": "C2D",
                        "count": SPECTRUM.count, "freedom": SPECTRUM.freedom,
                        "q_min": 1e5, "q_max": 1e6, "smear": 1e6}),
    (STRETCHED.at, {"qy": np.array([1e6, 2e6]), "qx": np.array([1e6, 3e6])}),
    (DIRECTIONAL.at, {"qy": np.array([1e6, 2e6]), "qx": np.array([1e6, 3e6])}),
    (rc.self_affine, {"grid": PERIODIC, "hurst": 0.8, "rms": 1e-7, "rms_band": (8e-6, 3e-6), "rolloff": 8e-6,
                      "long_cutoff": 1.2e-5, "anisotropy": (2.0, 0.5)}),
    (rc.synthesise, {"grid": PERIODIC, "spectrum": LAW, "rms": 1e-7, "rms_band": (8e-6, 3e-6)}),
    (rc.midpoint_line, {"grid": rc.Grid(65, 1e-6), "hurst": 0.8, "displacement": 1e-7}),
    (rc.midpoint_surface, {"grid": rc.Grid((17, 17), 1e-6), "hurst": 0.8, "displacement": 1e-7}),
    (rc.midpoint_surface, {"grid": rc.Grid((17, 17), 1e-6), "hurst": 0.8, "rms": 1e-7}),
    (rc.press_draws, {"spectrum": MEASURED, "modulus": 1e9, "pressure": 1e5, "size": 1.6e-5, "draws": 2}),
    (rc.resampled, {"surface": BALL, "grid": BALL.grid, "shift": (1e-6, 2e-6)}),
    (rc.combined, {"lower": BALL, "upper": BALL, "shift": (0.0, 0.0)}),
    (rc.height_histogram, {"surface": ROUGH, "bins": 5, "ends": (-1e-7, 1e-7)}),
    (rc.hurst_exponent, {"surface": ROUGH, "q_min": 3e5, "q_max": 3e6}),
    (rc.half_space, {"grid": FREE, "modulus": 1e9}),
    (rc.ring, {"grid": RING, "modulus": 1e9}),
    (rc.prescribed_displacement, {"mask": MASK, "displacement": 1e-8, "operator": rc.half_space(FREE, 1e9),
                                  "initial": np.full(FREE.shape, 1e5)}),
    (rc.ContactProblem, {"separation": CUT.heights.max() - CUT.heights, "operator": rc.half_space(FREE, 1e9),
                         "control": rc.Force(1e-3), "modulus": 1e9, "hardness": 1e8, "rise": 1e-8,
                         "lifting": 1e-12}),
    (PRESSED.problem.raised, {"rise": 1e-8, "lifting": 1e-12}),
    *((rc.differentiable_curve, {"grid": FREE, "modulus": 1e9, "hardness": 1e9, name: [value]})
      for name, value in (("forces", 1e-4), ("depths", 1e-8), ("pressures", 1e6))),
    (rc.differentiable_curve(FREE, 1e9, forces=[1e-4]).linearise, {"heights": CUT.heights}),
    (rc.press, {"surface": CUT, "modulus": 1e9, "depth": 1e-8}),
    (rc.press, {"surface": CUT, "modulus": 1e9, "pressure": 1e6}),
    (rc.press, {"surface": SCAN, "modulus": 1e9, "force": 1.0, "operator": LINE_OPERATOR}),
    *((rc.press_many, {"surfaces": [CUT], "modulus": 1e9, "hardness": 1e9, name: value})
      for name, value in (("force", 1e-3), ("depth", 1e-8), ("pressure", 1e6))),
    (rc.loading_path, {"surface": CUT, "modulus": 1e9, "forces": np.array([1e-3, 2e-3])}),
    (rc.loading_path, {"surface": CUT, "modulus": 1e9, "depths": [1e-8, 2e-8], "hardness": 1e9}),
    (rc.loading_path, {"surface": CUT, "modulus": 1e9, "pressures": [1e6, 2e6]}),
    (rc.loading_curve, {"surface": CUT, "modulus": 1e9, "forces": [1e-3, 2e-3], "hardness": 1e9}),
    (rc.loading_curve, {"surface": CUT, "modulus": 1e9, "depths": [1e-8, 2e-8]}),
    (rc.loading_curve, {"surface": CUT, "modulus": 1e9, "pressures": [1e6, 2e6]}),
    (rc.loading_loop, {"surface": CUT, "modulus": 1e9, "forces": [1e-3, 2e-3], "hardness": 1e8}),
    (rc.loading_loop, {"surface": CUT, "modulus": 1e9, "pressures": [1e6, 2e6], "hardness": 1e8}),
    (rc.load_range, {"surface": CUT, "modulus": 1e9, "count": 5, "hardness": 1e8}),
    *((rc.adhesive_state, {"surface": ROUGH, "modulus": 1e8, "adhesion": rc.Adhesion(1e-4, 5e-8), name: value})
      for name, value in STICKING.items()),
    *((function, {"surface": ROUGH, "modulus": 1e8, "adhesion": rc.Adhesion(1e-4, 5e-8), f"{name}s": [value]})
      for function in (rc.adhesive_path, rc.adhesive_curve) for name, value in STICKING.items()),
    (rc.adhesive_loop, {"surface": SOFT, "modulus": 1e8, "adhesion": STICKY, "depth": 1e-8, "points": 5}),
    (rc.detachment_path, {"solution": PRESSED, "work": 0.05, "depths": [0.0, -1e-8]}),
    (rc.detachment_curve, {"solution": PRESSED, "work": 0.05, "forces": [0.0, -1e-3]}),
    (rc.detachment_path, {"solution": PRESSED, "work": 0.05, "forces": [0.0, -1e-3]}),
    (rc.detachment_curve, {"solution": PRESSED, "work": 0.05, "depths": [0.0, -1e-8]}),
    (rc.detachment_path, {"solution": PRESSED, "work": 0.05, "pressures": [0.0, -1e3]}),
    (rc.detachment_curve, {"solution": PRESSED, "work": 0.05, "pressures": [0.0, -1e3]}),
    *((function, {"surface": ROUGH, "material": SOFT_MATERIAL, "times": [0.0, 1.0], "steps": 1, name: [0.0, value]})
      for function in (rc.viscoelastic_path, rc.viscoelastic_curve)
      for name, value in (("forces", 1e-6), ("depths", 1e-9), ("pressures", 1e3))),
    (rc.below, {"solution": PRESSED, "depth": 1e-6, "solid": STEEL}),
    (rc.displacement_below, {"solution": PRESSED, "depth": 1e-6, "solid": STEEL}),
    (rc.error_budget, {"pressed": PRESSED, "short_cutoff": 5e-6}),
    (rc.Noise, {"rms": 3e-9, "correlation_length": 4e-6}),
    (CURVE.fit, {"window": (1e-2, 1e-1)}),
    (rc.SurfaceSpecification, {"sigma": 1e-6, "slope": 0.1, "hurst": 0.8, "nayak": 9.0}),
    (rc.SurfaceSpecification, {"sigma": 1e-6, "hurst": 0.8, "rolloff": 5e-5, "short_cutoff": 5e-6}),
    (rc.SurfaceSpecification, {"sigma": 1e-6, "hurst": 0.8, "correlation_length": 2e-5, "nayak": 9.0}),
    (rc.specified, {"sigma": 1e-6, "slope": 0.1, "hurst": 0.8, "rolloff": 5e-5}),
    (rc.specified, {"ra": 1e-6, "hurst": 0.8, "correlation_length": 2e-5, "short_cutoff": 5e-6}),
    (rc.specified, {"rz": 6e-6, "rz_over_ra": 6.0, "nayak": 9.0}),
    (rc.theory_table, {"joint": JOINT, "modulus": 5e10, "names": "cmy", "pressures": [1e6], "hardness": 1e9}),
    (
        rc.theory_table,
        {"joint": JOINT, "modulus": 5e10, "names": "mikic", "pressures": [1e6]}
        | {"resistivities": (1e-8, 2e-8), "conductivities": (30.0, 40.0)},
    ),
    (rc.joint_conductance, {"solution": PRESSED, "conductivities": (30.0, 40.0), "emissivities": (0.5, 0.5),
                            "temperature": 300.0, "film": 1e-7}),
    (rc.joint_conductance, {"solution": PRESSED, "resistivities": (1e-8, 2e-8), "film": 1e-12}),
    (rc.ConductanceParts, {"conductivities": (30.0, 40.0), "emissivities": (0.5, 0.5), "temperature": 300.0,
                           "film": 1e-7}),
    (rc.Gas("air", pressure=1e5, accommodation=(0.9, 0.9)).conductance, {"gap": np.array([1e-6, 2e-6])}),
    (rc.conductance, {"contact": CURVE, "resistivities": (1e-8, 2e-8), "conductivities": (30.0, 40.0)}),
    (rc.reflection, {"contact": CURVE, "bodies": ("steel", "steel"), "frequency": 5e6, "densities": (8e3, 7e3)}),
    (rc.interface_table, {"curve": CURVE, "resistivities": (1e-8, 2e-8), "conductivities": (30.0, 40.0), "area": 1e-6,
                          "bodies": rc.Solid(0.75 * CURVE.modulus, 0.5), "friction": 0.3}),
    (rc.contact_flux, {"solution": PRESSED, "resistivities": (1e-8, 2e-8), "drop": 0.5}),
    (rc.contact_flux, {"solution": PRESSED, "conductivities": (30.0, 40.0)}),
    (rc.Liquid, {"viscosity": 1e-3, "density": 1000.0, "vapour_pressure": 2e3}),
    (rc.Gas, {"name": "air", "temperature": 300.0, "pressure": 1e5, "accommodation": (0.9, 0.9),
              "momentum_accommodation": 0.9}),
    *((getattr(rc.Gas("air"), name), {"pressure": 1e5}) for name in ("mean_free_path", "slip_length")),
    (rc.Gas("air").rarefaction, {"gap": 1e-6, "pressure": 1e5}),
    (rc.gap_flow, {"solution": PRESSED, "axis": 0, "slip_length": 1e-8, "closing_gap": 1e-9}),
    (rc.leak, {**_LEAK, "drop": 1e3, "seal_width": 1e-3, "circumference": 0.1}),
    (rc.leak, {**_LEAK, "upstream": 2e3, "downstream": 1e3}),
    (rc.sealing_load, {"surface": ROUGH, "modulus": 1e9, "axis": 0, "hardness": 1e9, "ratio": 0.5}),
    (rc.leak_rates, {"curve": FLOWN, "fluid": rc.Liquid(1e-3), "drop": 1e3, "seal_width": 1e-3, "circumference": 0.1}),
    (rc.loading_laws, {"surface": ROUGH, "modulus": 1e9, "names": "persson"}),
    (rc.slide, {"solution": PRESSED, "bodies": STEEL, "friction": 0.3, "displacement": 1e-9}),
    (rc.shear_cycle, {"solution": rc.press(ROUGH, STEEL, pressure=1e6), "bodies": STEEL, "friction": 0.3,
                      "displacement": 1e-9, "steps": 1, "shear_strength": 1e5}),
    (rc.shear_law, {"pressed": _OF_JOINT, "bodies": _STEELS, "friction": 0.3, "shear_strength": 1e8}),
    (SMOOTH.normal.gap_at, {"pressure": 5e5}),
    (SMOOTH.normal.stiffness_at, {"pressure": 5e5}),
    (SMOOTH.normal.pressure_at, {"gap": float(SMOOTH.normal.gap_at(5e5))}),
    (SMOOTH.stiffness, {"pressure": 5e5}),
    (SMOOTH.gross_slip, {"pressure": 5e5}),
    (SMOOTH.smallest_share, {"pressure": 5e5}),
    (SMOOTH.displacement, {"traction": 1e4, "pressure": 5e5}),
    (SMOOTH.traction, {"displacement": 1e-11, "pressure": 5e5}),
    *((call, {"pressure": 5e5} | amplitude) for call in (SMOOTH.loss, SMOOTH.cycle)
      for amplitude in ({"traction": 1e4}, {"displacement": 1e-11})),
    (SMOOTH.history, {"pressures": [5e5, 6e5], "tractions": [0.0, 1e4]}),
    (SMOOTH.iwan, {"pressure": 5e5, "displacement": 1e-11}),
    (SMOOTH.elements, {"pressure": 5e5}),
    *((call, {"displacement": 1e-11}) for call in (SMOOTH.elements(5e5).traction, SMOOTH.elements(5e5).loss)),
    (rc.shear_dataset, {"law": SHEARED, "pressures": [5e5, 1e6], "amplitudes": [0.5]}),
    *((function, {"solution": PRESSED, "bodies": STEEL, "friction": 0.3, name: [value, 2 * value]})
      for function in (rc.slide_path, rc.slide_curve) for name, value in (("forces", 1e-6), ("displacements", 1e-10))),
    (VISCO.kelvin_voigt, {"modulus": 1e9, "retardation_time": 1.0}),
    (VISCO.maxwell, {"modulus": 1e9, "relaxation_time": 1.0}),
    (VISCO.standard_solid, {"equilibrium": 1e9, "instantaneous": 2e9, "relaxation_time": 1.0}),
    (VISCO.viscous, {"viscosity": 1e9}),
    (VISCO.from_creep, {"instantaneous": 1e-9, "compliances": [1e-9], "times": [1.0], "fluidity": 1e-10}),
    (VISCO.reduced, {"modulus": SOFT_MATERIAL, "kind": "shear", "bulk": 1e10}),
    (VISCO.reduced, {"modulus": SOFT_MATERIAL, "kind": "shear", "poisson": 0.4}),
    (VISCO.power_law, {"modulus": 1e6, "time": 1.0, "exponent": 0.3, "band": (1e-2, 1e2), "equilibrium": 1e5,
                       "terms_per_decade": 1.0}),
    *((VISCO.from_dma, {"storage": [1e6, 2e6, 3e6], "loss": [1e5, 2e5, 1e5], name: [1.0, 10.0, 100.0],
                        "temperature": 300.0, "terms_per_decade": 1.0} | constant)
      for name, constant in (("frequencies", {"bulk": 1e9}), ("angular_frequencies", {"poisson": 0.4}))),
    (rc.Viscoelastic, {"equilibrium": 1e6, "moduli": (1e6, 2e6), "times": (0.1, 1.0), "dashpot": 1e3,
                       "band": (1e-2, 10.0), "temperature": 300.0, "misfit": 0.01}),
    (SOFT_MATERIAL.relaxation, {"time": 1.0}),
    (SOFT_MATERIAL.complex_modulus, {"angular_frequency": 1.0}),
    (SOFT_STATE.dynamic_stiffness, {"frequency": 1.0}),
    (SOFT_MATERIAL.shifted, {"factor": 10.0, "temperature": 300.0}),
    *((VISCO.transfer, {"curve": CURVE, "material": SOFT_MATERIAL, "times": [0.0, 1.0], name: values})
      for name, values in (("forces", [2e-2, 3e-2]), ("depths", [2.1e-6, 2.5e-6]))),
    (rc.Instrument, {"resolution": 1e-6, "tip_radius": 2e-8}),
    (rc.plot.von_mises_section, {"solution": PRESSED, "solid": STEEL, "deepest": 5e-6}),
]  # fmt: skip
# Units of parameters by their names, and where a name means something else.
UNITS = {
    "m": "radius inner outer side centre spacing edges heights below above range rms rms_band rolloff long_cutoff"
    " short_cutoff displacement displacements ends depth depths mean_gap mean_gaps deepest tip_radius thickness"
    " reference_length section_length amplitude wavelength rise separation sigma ra rz correlation_length size grid"
    " resolution slip_length closing_gap seal_width circumference head hole longest_wave",
    "s": "times time band relaxation_time retardation_time",
    "rad/s": "angular_frequency angular_frequencies",
    "Pa": "equilibrium instantaneous moduli storage loss bulk"
    " young_modulus modulus hardness pressure pressures initial upstream downstream vapour_pressure"
    " traction shear_strength",
    "N": "force forces window",
    "rad/m": "q_min q_max wavenumber qy qx",
    "J/m^2": "work",
    "m^2": "area m0",
}
UNIT = {name: unit for unit, names in UNITS.items() for name in names.split()}
UNIT |= {
    "shift": "m",
    "half_angle": "rad",
    "m4": "1/m^2",
    "density": "m^4",
    "smear": "rad^2/m^2",
    "lifting": "J",
    "angle": "rad",
}
UNIT |= {"frequency": "Hz", "densities": "kg/m^3"}
UNIT |= {"film": "m^2*K/W", "gap": "m", "temperature": "K", "viscosity": "Pa*s", "drop": "V"}
UNIT |= {
    "shift": "m",
    "compliances": "1/Pa",
    "compliance": "1/Pa",
    "fluidity": "1/(Pa*s)",
    "dashpot": "Pa*s",
    "frequencies": "Hz",
}
UNIT |= {"resistivities": "ohm*m", "resistivity": "ohm*m", "conductivities": "W/m/K", "conductivity": "W/m/K"}
JOINT_UNITS = {
    "stiffness": "Pa/m",
    "compliance": "m/Pa",
    "compliance_error": "m/Pa",
    "closures": "m",
    "resolution": "m",
}
# What a solve stops at, within its tolerance.
ROUNDING = {"balance", "residual", "stiffness_residual", "step_residual", "steps", "products"}
MDR = rc.mdr
LINES = np.array([[0.0, 1e-7, -1e-7, 0.0, 2e-7, 1e-8, 0.0, 0.0]])
PRESSED_TIP = MDR.indentation.indent(TIP, 1e9, force=1e-3)
SLOW = {"profile": TIP, "material": SOFT_MATERIAL, "times": [0.0, 1.0]}
# The method of dimensionality reduction declares no units, and windows of fits have none: plain numbers only.
PLAIN_ONLY = [
    (rc.foundation, {"grid": SCAN.grid, "modulus": 1e9}),
    (MDR.adhesion.jkr, {"profile": TIP, "modulus": 1e9, "work": 0.05}),
    *((getattr(STICKY_TIP, name), {"radius": 1e-5})
      for name in ("elongation", "depth", "force", "depth_slope", "force_slope", "at")),
    (STICKY_TIP.energy, {"radius": 1e-5, "depth": 1e-8}),
    (STICKY_TIP.pull_off, {"machine_stiffness": 1e3}),
    (MDR.adhesive_path.adhesive_path, {"adhesion": STICKY_TIP, "depths": [0.0, 1e-8], "machine_stiffness": 1e5}),
    (MDR.adhesive_path.adhesive_path, {"adhesion": STICKY_TIP, "forces": [0.0, 1e-8]}),
    *((MDR.indentation.indent, {"profile": TIP, "modulus": 1e9, name: value})
      for name, value in (("force", 1e-3), ("depth", 1e-8), ("contact_radius", 1e-5))),
    *((MDR.indentation.indentation_curve, {"profile": TIP, "modulus": 1e9, name: [value]})
      for name, value in (("forces", 1e-3), ("depths", 1e-8), ("contact_radii", 1e-5))),
    *((getattr(PRESSED_TIP, name), {"r": 1e-6}) for name in ("pressure", "displacement", "gap")),
    (MDR.indenter.cone, {"slope": 0.1, "flat": 1e-6}),
    (MDR.indenter.equivalent_roughness, {"hurst": 0.8, "rms": 1e-7, "length": 1e-3}),
    (MDR.indenter.flat_punch, {"radius": 1e-3}),
    (MDR.indenter.from_transform, {"transform": lambda x: x**2, "radius": 1e-3}),
    (MDR.indenter.of, {"height": lambda r: r**2, "radius": 1e-3}),
    (MDR.indenter.paraboloid, {"radius": 1e-3, "flat": 1e-6}),
    (MDR.indenter.power_law, {"exponent": 2.0, "coefficient": 1e3, "flat": 1e-6}),
    (MDR.indenter.ripples, {"amplitude": 1e-8, "wavelength": 1e-5, "radius": 1e-3}),
    (MDR.indenter.rounded_cone, {"slope": 0.1, "radius": 1e-3}),
    (MDR.indenter.sampled, {"r": np.linspace(0, 1e-3, 9), "height": np.linspace(0, 1e-3, 9) ** 2}),
    (MDR.indenter.sampled_transform, {"x": np.linspace(0, 1e-3, 9), "transform": np.linspace(0, 1e-3, 9) ** 2}),
    (MDR.indenter.sphere, {"radius": 1e-3}),
    (MDR.rough_line.loading_curves, {"heights": LINES, "spacing": 1e-6, "modulus": 1e9, "forces": [1e-3, 2e-3]}),
    (MDR.rough_line.loading_curves, {"heights": LINES, "spacing": 1e-6, "modulus": 1e9, "depths": [1e-8, 2e-8]}),
    (MDR.sliding_friction.sliding_friction, {"heights": LINES, "spacing": 1e-6, "modulus": 1e9, "relaxation_time": 1e-3,
                                             "force": 1e-3, "speeds": [1e-3]}),
    (MDR.slip_history.slip_history, {"profile": TIP, "modulus": 1e9, "shear_modulus": 1e9, "friction": 0.3,
                                     "normal_force": [1e-3], "force": [1e-5]}),
    (MDR.tangential.partial_slip, {"indentation": PRESSED_TIP, "shear_modulus": 1e9, "friction": 0.3, "force": 1e-5}),
    (MDR.tangential.partial_slip, {"indentation": PRESSED_TIP, "shear_modulus": 1e9, "friction": 0.3,
                                   "displacement": 1e-10}),
    (MDR.viscoelastic_history.depth_history, SLOW | {"depths": [0.0, 1e-8]}),
    (MDR.viscoelastic_history.force_history, SLOW | {"forces": [0.0, 1e-4]}),
    (rc.statistics.force_window, {"lowest": 1e-4, "highest": 1e-2}),
    (rc.statistics.resolved_window, {"cell": 0.01, "full_contact_stiffness": 1.0, "highest": 1e-2}),
    (MDR.line_scan.scan_curves, {"scan": SCAN, "modulus": 1e9, "rng": None, "forces": [1e-3, 1e-2], "count": 2}),
]  # fmt: skip
# The numerical core takes arrays as its own border has left them.
INSIDE = re.compile(r"(Capabilities|(Shear)?Operator|ActiveSet|PolonskyKeer|ContactProblem)\b")


def unit_of(call, name, good):
    if call is rc.Depth:
        return "m"
    if call is rc.Force:
        return "N"
    if call in (rc.leak, rc.leak_rates, rc.joint_leak) and name == "drop":
        return "Pa"
    if name == "density" and call in (rc.Liquid, rc.Material):
        return "kg/m^3"
    if call is VISCO.from_creep and name == "instantaneous":
        return "1/Pa"
    if call == SOFT_STATE.dynamic_stiffness:
        return "rad/s"
    if call in (rc.JointStiffness, rc.JointClosures) and name in JOINT_UNITS:
        return JOINT_UNITS[name]
    if call == INFERRED.share_below:
        return "m"
    if call == rc.JointStiffness.from_reflection and name == "impedances":
        return "Pa*s/m"
    if call is rc.load_cycle:
        return None  # of forces or of displacements
    if call is rc.press and good.get("operator") is LINE_OPERATOR and name == "force":
        return "N/m"
    if call is rc.joint_conductance and name == "film" and "resistivities" in good:
        return "ohm*m^2"
    if call in (rc.steady_sliding, rc.friction_curve) and name.startswith("speed"):
        return "m/s"
    return UNIT.get(name)


PLACES = [*CALLS.items(), *MORE]


def parameters(with_unit):
    for place, (call, good) in enumerate(PLACES):
        if call.__module__.startswith("roughcontact.mdr"):
            continue
        for name, value in good.items():
            number = isinstance(value, int | float | np.ndarray) or (
                isinstance(value, list | tuple) and all(isinstance(one, int | float) for one in value)
            )
            array_of_others = isinstance(value, np.ndarray) and value.dtype.kind != "f"
            has_unit = unit_of(call, name, good) is not None
            if number and not array_of_others and not isinstance(value, bool) and has_unit == with_unit:
                yield pytest.param(place, name, id=f"{place}-{call.__qualname__}-{name}")


def fresh(call, good):
    """Return the arguments, with a source of random numbers of its own where one is wanted."""
    return good | ({"rng": np.random.default_rng(7)} if "rng" in inspect.signature(call).parameters else {})


def answer(call, good):
    found = call(**fresh(call, good))
    return list(found) if isinstance(found, Iterator) else found


@cache
def plain(place):
    """Return what plain numbers are answered: the same for all parameters of a call."""
    return answer(*PLACES[place])


def carried(value, unit):
    """Return a value in a unit a thousandth as large as the SI unit; of a list one quantity each."""
    quantity = U.Quantity(1.0, unit)
    if isinstance(value, list):
        return [1e3 * one * (quantity / 1e3) for one in value]
    return 1e3 * np.asarray(value)[()] * (quantity / 1e3)


def assert_same(found, wanted):
    if isinstance(wanted, xarray.Dataset | xarray.DataArray):
        xarray.testing.assert_allclose(found, wanted, rtol=1e-6)
    elif is_dataclass(wanted) and not isinstance(wanted, type):
        assert type(found) is type(wanted)
        for field in fields(wanted):
            if field.name not in ROUNDING and not field.name.startswith("_"):
                assert_same(getattr(found, field.name), getattr(wanted, field.name))
    elif isinstance(wanted, list | tuple):
        assert len(found) == len(wanted)
        for one, other in zip(found, wanted, strict=True):
            assert_same(one, other)
    elif isinstance(wanted, np.ndarray | float | np.floating) and np.asarray(wanted).dtype.kind == "f":
        assert not hasattr(found, "units")
        # To the tolerance of a solve: a converted number may differ in its last digit.
        scale = np.max(np.abs(np.asarray(wanted)[np.isfinite(wanted)]), initial=0.0)
        np.testing.assert_allclose(
            np.asarray(found, float), np.asarray(wanted, float), rtol=1e-6, atol=1e-6 * scale
        )
    elif isinstance(wanted, int | bool | Enum | type(None)):
        assert found == wanted


@pytest.mark.parametrize(("place", "name"), list(parameters(with_unit=True)))
def test_a_value_with_a_unit_is_converted(place, name):
    call, good = PLACES[place]
    unit = unit_of(call, name, good)
    assert_same(answer(call, good | {name: carried(good[name], unit)}), plain(place))


@pytest.mark.parametrize(("place", "name"), list(parameters(with_unit=True)))
def test_another_dimension_is_refused(place, name):
    call, good = PLACES[place]
    with pytest.raises(ValueError, match=rf"{name} must be in .*not in .*candela"):
        answer(call, good | {name: carried(good[name], "kcd")})


@pytest.mark.parametrize(("place", "name"), list(parameters(with_unit=False)))
def test_a_pure_number_takes_no_dimension(place, name):
    call, good = PLACES[place]
    with pytest.raises(ValueError, match="meter"):
        answer(call, good | {name: carried(good[name], "m")})


@pytest.mark.parametrize(("call", "good"), PLAIN_ONLY, ids=lambda value: getattr(value, "__qualname__", ""))
def test_reduction_takes_plain_numbers_only(call, good):
    answer(call, good)
    for name, value in good.items():
        if isinstance(value, float | np.ndarray | list):
            with pytest.raises(ValueError, match="plain numbers"):
                answer(call, good | {name: carried(value, "m")})


def test_every_public_parameter_with_a_unit_is_tried():
    tried = {
        (inspect.unwrap(getattr(call, "__func__", call)).__qualname__, name)
        for call, good in PLACES
        for name in good
    }
    numeric = re.compile(r"float|(?<!Data)Array\b|ArrayLike|Loads?\b|Centre|Hardness")
    left = set()
    for public in public_names():
        value = public.value
        if public.room in ("theory", "mdr", "statistics") or isinstance(value, property):
            continue
        if not callable(value) or (inspect.isclass(value) and _never_called(value)):
            continue
        stated = {
            name.strip(): " ".join(entry.desc)
            for entry in _parsed(value)["Parameters"]
            for name in entry.name.split(",")
        }
        qualname = inspect.unwrap(value).__qualname__
        for name, parameter in inspect.signature(value).parameters.items():
            with_unit = "[" in stated.get(name, "") and numeric.search(str(parameter.annotation))
            if with_unit and "Callable" not in str(parameter.annotation) and not INSIDE.match(qualname):
                left |= {(qualname, name)} - tried
    assert left == set()
