"""Every field of every part and source of a recipe, and a small job in which it has a meaning."""

import copy
from dataclasses import is_dataclass
from typing import get_type_hints

import pytest

from roughcontact.errors import InputError
from roughcontact.recipe.jobs import JOBS
from roughcontact.recipe.recipe_fields import specs
from roughcontact.recipe.source import SOURCES
from roughcontact.recipe.written import from_plain

FILE = {"file": "part.x3p"}
BODIES = {"modulus": "110GPa"}
ADHESION = {"work": "10mJ/m^2", "range": "20nm"}
SPECTRUM = {"sigma": "1um", "slope": "1", "hurst": "0.8", "rolloff": "50um"}
SMALLEST = {
    "surface": {},
    "press": {"load": {"depth": "1um"}, "bodies": BODIES},
    "leak": {
        "load": {"depth": "1um"},
        "bodies": BODIES,
        "fluid": {"viscosity": "1mPa*s"},
        "seal": {"drop": "1bar"},
    },
    "shear": {
        "bodies": {"materials": "steel,aluminium"},
        "shear": {"pressures": "1MPa", "friction": "0.2"},
    },
    "curve": {"bodies": BODIES},
    "creep": {"history": {"history": "0s:0um,1s:1um"}, "bodies": {"material": "rubber.toml"}},
    "adhesion press": {"load": {"force": "1mN"}, "bodies": BODIES, "adhesion": ADHESION},
    "adhesion curve": {"loads": {"depths": "0nm,5nm"}, "bodies": BODIES, "adhesion": ADHESION},
    "adhesion loop": {"turn": {"depth": "5nm"}, "bodies": BODIES, "adhesion": ADHESION},
    "adhesion detach": {"load": {"force": "1mN"}, "bodies": BODIES, "adhesion": {"work": "10mJ/m^2"}},
    "sliding": {
        "bodies": {"material": "rubber.toml"},
        "sliding": {"pressure": "1kPa", "speeds": "1mm/s"},
    },
    "joint": {
        "bodies": BODIES,
        "pressure": {"bolt_force": "1kN", "head": "13mm", "hole": "9mm", "thickness": "1cm"},
    },
    "theory": {
        "source": {"sigma": "1um", "slope": "0.1"},
        "bodies": BODIES,
        "pressures": {"pressures": "1MPa"},
        "theories": {"theory": "mikic"},
    },
    "infer": {
        "source": {"file": "joint.csv"},
        "bodies": BODIES,
        "joint": {"area": "2cm^2", "branch": "loading"},
    },
}
SOURCE = {
    "file": FILE,
    "self-affine": {"kind": "self-affine", "hurst": "0.8", "rms": "1um", "size": "1mm"},
    "specified": {"kind": "specified", **SPECTRUM, "size": "1mm"},
    "shape": {"kind": "shape", "shape": "sphere", "radius": "5mm", "size": "1mm"},
    "example": {"kind": "example", "example": "ground"},
    "combined": {"kind": "combined", "lower": FILE, "upper": {"kind": "example", "example": "ground"}},
    "python": {"kind": "python", "surface_sha256": "0" * 64},
}

_YOUNG = {"modulus": None, "young": "210GPa", "poisson": "0.3"}
_RZ = {"sigma": None, "rz": "6um", "rz_over_ra": "6"}
_OF_JOINT = {
    "ra": {"sigma": None},
    "rz": _RZ,
    "rz_over_ra": _RZ,
    "rolloff": {"hurst": "0.8"},
    "correlation_length": {"hurst": "0.8", "rolloff": None},
    "short_cutoff": {"hurst": "0.8", "rolloff": "100um", "slope": None},
    "nayak": {"rolloff": None},
}
_GAS = {"viscosity": None, "gas": "air,293K"}
_TABLE = dict.fromkeys(("bolt_force", "head", "hole", "thickness"))
_WET = {"leak": "0", "viscosity": "1mPa*s", "drop": "1bar"}
_ECHO = {"quantity": "reflection", "frequency": "2MHz"}
_FACES = {"rms": "1.2um", "rms_error": "10%", "rolloff": "100um", "rolloff_error": "30%", "hurst": "0.8"}
_SOFT = {"hardness": "2GPa", "hardness_error": "10%"}
_WAVE = {"shape": "wave", "radius": None, "amplitude": "1um", "wavelength": "0.1mm"}
# What stands beside a field where it has a meaning; None where it takes the place of another.
BESIDE = {
    "Preparation.tip_shape": {"tip": "2um"},
    "Preparation.alias": {"downsample": "2"},
    "Preparation.share": {"window": "tukey"},
    **{f"OneLoad.{name}": {"depth": None} for name in ("force", "pressure")},
    **{f"AdhesiveLoad.{name}": {"force": None} for name in ("pressure", "depth", "mean_gap")},
    **{f"AdhesiveLoads.{name}": {"depths": None} for name in ("forces", "pressures", "mean_gaps")},
    "Bodies.materials": {"modulus": None},
    **{f"Bodies.{name}": _YOUNG for name in ("young", "poisson")},
    **{f"Bodies.{name}": _YOUNG | {"young2": "70GPa", "poisson2": "0.3"} for name in ("young2", "poisson2")},
    **{f"{part}.flow": {"hardness": "2GPa"} for part in ("AfterLoad", "LoopOfLoads")},
    "AfterLoad.after": {"hardness": "2GPa"},
    "LoopOfLoads.loop": {"hardness": "2GPa"},
    "Errors.shortest_wave": {"errors": True},
    "Errors.noise": {"errors": True},
    "Errors.noise_length": {"errors": True, "noise": "3nm"},
    "LeakAlong.missing": {"leak": "0"},
    "HeatParts.emissivity": {"temperature": "20degC"},
    "HeatParts.temperature": {"emissivity": "0.2"},
    "Theories.hurst": {"theory": "finite-size"},
    "Theories.rolloff": {"theory": "finite-size"},
    "Theories.radius": {"theory": "hertz"},
    "InterfaceTables.table_area": {"table": "lammps"},
    "InterfaceTables.friction": {"table": "calculix"},
    **{
        f"{part}.{name}": beside
        for part in ("Specified", "SpecifiedJoint")
        for name, beside in _OF_JOINT.items()
    },
    "Sliding.force": {"pressure": None},
    "Ultrasound.density": {"frequency": "5MHz"},
    "Fluid.gas": _GAS,
    **{
        f"Seal.{name}": {"drop": None, "upstream": "2bar", "downstream": "1bar"}
        for name in ("upstream", "downstream")
    },
    **{
        f"Seal.{name}": {"seal_width": "1mm", "circumference": "0.1m"}
        for name in ("seal_width", "circumference")
    },
    "JointPressure.pressure_field": _TABLE,
    "JointPressure.sha256": _TABLE | {"pressure_field": "field.csv"},
    "JointShear.amplitude": {"friction": "0.2"},
    **dict.fromkeys(("JointLeak.leak", "JointLeak.viscosity", "JointLeak.drop"), _WET),
    "JointMeasurement.resolution": {"quantity": "closure"},
    "JointMeasurement.compliance": {"quantity": "closure"},
    "JointMeasurement.compliance_error": {"quantity": "closure", "compliance": "1e-14m/Pa"},
    "JointMeasurement.frequency": _ECHO | {"impedance": "46MPa*s/m"},
    "JointMeasurement.impedance": _ECHO,
    **dict.fromkeys(("MeasuredJoint.hardness", "MeasuredJoint.hardness_error"), _SOFT),
    **{
        f"JointProfile.{name}": _FACES
        for name in ("rms", "rms_error", "rolloff", "rolloff_error", "hurst", "hurst_error", "plan")
    },
    "SmoothBody.slope": {"shape": "cone", "radius": None},
    "SmoothBody.amplitude": _WAVE,
    "SmoothBody.wavelength": _WAVE,
}
# Other parts of the job in which a field has a meaning: noise needs a force, a gas both pressures, sound and friction
# two bodies, heat the conductivity of the bodies.
ELSEWHERE = {
    **{
        field: {"bodies": {"materials": "steel,aluminium"}}
        for field in ("Ultrasound.frequency", "Ultrasound.density", "InterfaceTables.friction")
    },
    **{field: {"load": {"force": "1mN"}} for field in ("Errors.noise", "Errors.noise_length")},
    **{
        f"HeatParts.{name}": {"conduction": {"conductivity": "400W/m/K"}}
        for name in ("gas", "emissivity", "temperature", "film")
    },
    **{
        f"JointShear.{name}": {"bodies": {"materials": "steel,aluminium"}}
        for name in ("friction", "amplitude")
    },
    "Fluid.gas": {"seal": {"upstream": "2bar", "downstream": "1bar"}},
}


def smallest(job, kind="file"):
    """Return the smallest job of a name, as plain values."""
    return copy.deepcopy({"job": job, "source": SOURCE[kind], **SMALLEST[job]})


def _parts():
    """Yield each part: its class, a job that has it, under which name, and the kind of source."""
    seen = set()
    for job in JOBS.values():
        for name, kind in get_type_hints(job).items():
            if is_dataclass(kind) and kind not in seen:
                seen.add(kind)
                yield kind, job.NAME, name, "file"
    for source in SOURCES:
        yield source, "surface", "source", source.KIND


FIELDS = {
    f"{part.__name__}.{each.name}": (each, spec, job, name, source)
    for part, job, name, source in _parts()
    for each, spec in specs(part)
}


def with_value(field, value):
    """Return a small job with another value of a field, and what stands beside it."""
    each, _, job, name, source = FIELDS[field]
    plain = smallest(job, source)
    part = plain.get(name, {}) | BESIDE.get(field, {}) | {each.name: value}
    return plain | ELSEWHERE.get(field, {}) | {name: part}


def place_of(field):
    """Return the place that errors name."""
    each, _, _, name, _ = FIELDS[field]
    return f"{name}.{each.name}"


def refused(plain):
    """Return the error about a recipe that is refused before any file is looked for."""
    with pytest.raises(InputError) as met:
        from_plain(plain)
    error = met.value
    assert error.remedy, error
    assert error.place
    return error
