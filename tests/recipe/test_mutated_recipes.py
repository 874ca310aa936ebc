"""Every field of every part out of range or of a wrong kind: refused with its place and a remedy that works."""

import datetime

import numpy as np
import pytest

import roughcontact as rc
from every_field import BESIDE, FIELDS, place_of, refused, with_value
from roughcontact.recipe.jobs import calls_of
from roughcontact.recipe.written import from_plain, to_plain

# Of each field: a value out of range, and what the remedy says to write instead; None to leave it out.
OUT_OF_RANGE = {
    "Preparation.crop": ("9:9,0:5", "0:40,5:45"),
    "Preparation.despike": ("fill", "filled", "missing"),
    "Preparation.mask": ("square=0:9,0:9", "box=0:9,10:30", "ellipse=0:9,10:30", "above=3um", "below=-3um"),
    "Preparation.align": ("lines", "rows", "columns"),
    "Preparation.level": ("planar", "plane", "none", "mean", "quadratic"),
    "Preparation.form": ("13", "0", "12", "sphere", "cylinder"),
    "Preparation.fill": ("yes", True, False),
    "Preparation.tip": ("0.2", "2um"),
    "Preparation.tip_shape": ("cone", "sphere", "paraboloid"),
    "Preparation.short_cutoff": ("0um", "5um"),
    "Preparation.long_cutoff": ("-1mm", "5um"),
    "Preparation.average": ("0", "2"),
    "Preparation.downsample": ("1.5", "2"),
    "Preparation.alias": ("no", True, False),
    "Preparation.window": ("hamming", "hann", "welch", "tukey"),
    "Preparation.share": ("1.1", "0.25"),
    "OneLoad.force": ("-1N", "10N"),
    "OneLoad.pressure": ("0Pa", "1MPa"),
    "OneLoad.depth": ("-1nm", "0"),
    "Bodies.modulus": ("110", "110GPa", "110Pa"),
    "Bodies.materials": ("steel", "steel,aluminium", "steel,steel", "steel,rigid"),
    "Bodies.young": ("-1GPa", "110GPa"),
    "Bodies.poisson": ("0.6", "0.3"),
    "Bodies.young2": ("0Pa", "110GPa"),
    "Bodies.poisson2": ("-1", "0.3"),
    "Contact.profile": ("springs", "line", "winkler"),
    "Contact.tolerance": ("0.1", "1e-8"),
    "AfterLoad.hardness": ("2", "2GPa", "2Pa"),
    "AfterLoad.after": ("1nm", None, "2um"),
    "AfterLoad.flow": ("up", "removed", "raised"),
    "Errors.errors": ("all", True, False),
    "Errors.shortest_wave": ("0", "5um"),
    "Errors.noise": ("-3nm", "5um"),
    "Errors.noise_length": ("nan", "5um"),
    "PressureTheory.theory": ("gw", "persson"),
    "Shear.pressures": ("2MPa,1MPa", "1MPa,2MPa"),
    "Shear.friction": ("0", "0.2"),
    "Shear.amplitude": ("1.1", "0.5"),
    "Shear.shear_strength": ("-1MPa", "1MPa"),
    "Shear.compute": ("all", True, False),
    "RisingLoads.forces": ("10N:1N:5", "1mN:1N:100"),
    "RisingLoads.pressures": ("1kPa:1MPa:1", "1kPa:1MPa:2"),
    "RisingLoads.depths": ("2nm,1nm", "1nm,2nm"),
    "LoopOfLoads.hardness": ("-2GPa", "2GPa"),
    "LoopOfLoads.loop": ("twice", True, False),
    "LoopOfLoads.flow": ("sideways", "removed", "raised"),
    "Conduction.resistivity": ("0,0", "17nohm*m"),
    "Conduction.conductivity": ("-1W/m/K", "400W/m/K"),
    "Conduction.of": ("patch", "interface", "total"),
    "Ultrasound.frequency": ("5", "5MHz", "5Hz"),
    "Ultrasound.density": ("7.85", "7.85g/cm^3", "7.85kg/m^3"),
    "HeatParts.gas": ("air,1bar,20degC", "air,1bar,20degC,alpha=0.9:0.9"),
    "HeatParts.emissivity": ("1.2", "0.2"),
    "HeatParts.temperature": ("-300degC", "20degC"),
    "HeatParts.film": ("0m^2*K/W", "0.1mm^2*K/W"),
    "Theories.theory": ("person", "persson"),
    "Theories.hurst": ("4", "0.8"),
    "Theories.rolloff": ("0", "5um"),
    "Theories.radius": ("-5mm", "5um"),
    "InterfaceTables.table": ("csv,csv", "csv,abaqus"),
    "InterfaceTables.table_area": ("0mm^2", "1mm^2"),
    "InterfaceTables.friction": ("0", "0.3"),
    "Units.unit_stiffness": ("N/m", "N/um/mm^2"),
    "Units.unit_pressure": ("mN", "MPa"),
    "AdhesiveLoad.force": ("-1mN",),  # the remedy is another job: see below
    "AdhesiveLoad.pressure": ("-1kPa",),
    "AdhesiveLoad.depth": ("5N", "5um"),
    "AdhesiveLoad.mean_gap": ("0nm", "5um"),
    "AdhesionLaw.work": ("0", "50mJ/m^2"),
    "AdhesionLaw.range": ("-1nm", "5um"),
    "AdhesionLaw.law": ("lennard-jones", "exponential", "dugdale"),
    "AdhesionLaw.allow_unresolved": (1, True, False),
    "AdhesiveLoads.depths": (",", "0m,20nm,-20nm"),
    "AdhesiveLoads.forces": ("-1N,0N", "0,-1N"),
    "AdhesiveLoads.pressures": ("-1kPa,0Pa", "0,-1kPa"),
    "AdhesiveLoads.mean_gaps": ("100nm,0nm", "100nm"),
    "Turn.depth": ("much", "5um"),
    "Turn.points": ("1", "2"),
    "Sticking.work": ("-1mJ/m^2", "50mJ/m^2"),
    "FallingLoads.depths": ("1nm,2nm", "1nm"),
    "FallingLoads.forces": ("10mN,0N", "0.001,0N"),
    "FallingLoads.pressures": ("0Pa,1kPa", "0Pa"),
    "Fluid.viscosity": ("0", "1mPa*s"),
    "Fluid.density": ("-1kg/m^3", "1000kg/m^3"),
    "Fluid.vapour_pressure": ("-1Pa", "1MPa"),
    "Fluid.gas": ("air", "air,20degC"),
    "Seal.drop": ("0bar", "1MPa"),
    "Seal.upstream": ("0bar", "1MPa"),
    "Seal.downstream": ("-1bar", "1MPa"),
    "Seal.axis": ("2", "0", "1"),
    "Seal.seal_width": ("0mm", "5um"),
    "Seal.circumference": ("-1m", "5um"),
    "Seal.missing": ("shut", "closed", "open"),
    "LoadHistory.history": ("0s:0N,1s:1MPa", "0s:0N,1s:1N"),
    "ContactOverTime.profile": ("springs", "line", "winkler"),
    "ContactOverTime.tolerance": ("0.1", "1e-8"),
    "ContactOverTime.time_tolerance": ("1", "1e-3"),
    "ContactOverTime.steps": ("0", "2"),
    "LeakAlong.leak": ("y", "0", "1"),
    "LeakAlong.missing": ("shut", "closed", "open"),
    "ViscoelasticBody.material": ("", "rubber.toml"),
    "ViscoelasticBody.sha256": ("abc", None, "0" * 64),
    "JointPressure.pressure_field": ("", "field.csv"),
    "JointPressure.sha256": ("abc", None, "0" * 64),
    "JointPressure.bolt_force": ("0kN", "10N"),
    "JointPressure.head": ("-13mm", "5um"),
    "JointPressure.hole": ("0mm", "5um"),
    "JointPressure.thickness": ("0mm", "5um"),
    "JointPressure.half_angle": ("-30deg", "30deg"),
    "JointShear.friction": ("0", "0.2"),
    "JointShear.amplitude": ("0um", "5um"),
    "JointLeak.leak": ("2", "0", "1"),
    "JointLeak.viscosity": ("0", "1mPa*s"),
    "JointLeak.drop": ("0bar", "1MPa"),
    "Sliding.pressure": ("0Pa", "1MPa"),
    "Sliding.force": ("-1N", "10N"),
    "Sliding.speeds": ("1m/s:1mm/s:3", "1mm/s:1m/s:100"),
    "Sliding.direction": ("30", "x", "y", "30deg"),
    "File.file": ("", "part.x3p"),
    "File.channel": ("", None, "height"),
    "File.unit": ("parsnip", "um", "1e-6"),
    "File.size": ("1mm x 2mm x 3mm", "1mm", "1mm x 2mm"),
    "File.periodic": ("both", True, False),
    "File.sha256": ("abc", None, "0" * 64),
    "SelfAffine.hurst": ("3.1", "0.8"),
    "SelfAffine.rms": ("0", "5um"),
    "SelfAffine.rms_band": ("10um:1mm", "1mm:10um"),
    "SelfAffine.size": ("1 x", "5um"),
    "SelfAffine.points": ("0", "512", "512x256"),
    "SelfAffine.seed": ("-1", "2"),
    "SelfAffine.rolloff": ("0mm", "5um"),
    "SelfAffine.long_cutoff": ("-5um", "5um"),
    "SelfAffine.short_cutoff": ("5N", "5um"),
    "SelfAffine.periodic": (0, True, False),
    "SelfAffine.nodal": (1.0, True, False),
    **{
        f"{part}.{name}": values
        for part in ("Specified", "SpecifiedJoint")
        for name, values in {
            "sigma": ("0um", "5um"),
            "ra": ("0um,1um", "5um"),
            "rz": ("-6um", "5um"),
            "rz_over_ra": ("0.5", "6"),
            "slope": ("0", "0.12"),
            "hurst": ("1.1", "0.8"),
            "nayak": ("1.5", "20"),
            "rolloff": ("0mm", "5um"),
            "correlation_length": ("5N", "5um"),
            "short_cutoff": ("-5um", "5um"),
        }.items()
    },
    "Specified.size": ("1 x", "5um"),
    "Specified.points": ("0", "512", "512x256"),
    "Specified.seed": ("-1", "2"),
    "Specified.periodic": (0, True, False),
    "NominalPressures.pressures": ("5MPa:1MPa:3", "1kPa:1MPa:100"),
    "JointTheories.theory": ("hertz", "persson", "mikic"),
    "JointTheories.hardness": ("2", "2GPa", "2Pa"),
    "JointMeasurement.file": ("", "joint.csv"),
    "JointMeasurement.columns": ("", "pressure [MPa], stiffness [N/um/mm^2]"),
    "JointMeasurement.quantity": ("depth", "stiffness"),
    "JointMeasurement.errors": ("0%", "5%"),
    "JointMeasurement.gain": ("100%", "5%"),
    "JointMeasurement.resolution": ("0nm", "5um"),
    "JointMeasurement.compliance": ("-1m/Pa", "1e-14m/Pa"),
    "JointMeasurement.compliance_error": ("0m/Pa", "1e-14m/Pa"),
    "JointMeasurement.frequency": ("2", "2MHz", "2Hz"),
    "JointMeasurement.impedance": ("-1Pa*s/m", "46MPa*s/m"),
    "JointMeasurement.sha256": ("0" * 63, "0" * 64),
    "MeasuredJoint.area": ("0m^2", "1mm^2"),
    "MeasuredJoint.branch": ("reloading", "loading", "unloading"),
    "MeasuredJoint.modulus_error": ("0%", "5%"),
    "MeasuredJoint.hardness": ("0Pa", "2GPa"),
    "MeasuredJoint.hardness_error": ("0%", "5%"),
    "JointProfile.plan": ("0%", "5%"),
    "JointProfile.rms": ("0um", "5um"),
    "JointProfile.rms_error": ("-5%", "5%"),
    "JointProfile.rolloff": ("0um", "5um"),
    "JointProfile.rolloff_error": ("200%", "5%"),
    "JointProfile.hurst": ("1.3", "0.8"),
    "JointProfile.hurst_error": ("0", "0.15"),
    "SmoothBody.shape": ("cube", "sphere", "cylinder", "paraboloid"),
    "SmoothBody.radius": ("0mm", "5um"),
    "SmoothBody.slope": ("0", "0.1"),
    "SmoothBody.amplitude": ("-1um", "5um"),
    "SmoothBody.wavelength": ("0", "5um"),
    "SmoothBody.size": ("-1mm", "5um"),
    "SmoothBody.points": ("12x", "512", "512x256"),
    "SmoothBody.periodic": ("false", True, False),
    "Example.example": ("milled", "ground", "blasted", "turned"),
    "Combined.turned_about": ("z", "x", "y"),
    "InPython.surface_sha256": ("0" * 63, "0" * 64),
    "InPython.history": ([["a"]], ["a"]),
}
# Fields whose remedy says what to do with the value, and does not name another.
INSTRUCTED = {
    *("Preparation.crop", "AfterLoad.after", "RisingLoads.pressures", "RisingLoads.depths"),
    *("AdhesiveLoads.forces", "AdhesiveLoads.pressures"),
    *("FallingLoads.depths", "FallingLoads.forces", "FallingLoads.pressures"),
    *("File.file", "File.channel", "File.unit", "File.sha256", "InPython.surface_sha256"),
    *("LoadHistory.history", "ViscoelasticBody.material", "ViscoelasticBody.sha256"),
    *("JointPressure.pressure_field", "JointPressure.sha256", "Shear.pressures"),
    *("JointMeasurement.file", "JointMeasurement.columns", "JointMeasurement.sha256"),
}
# What no field takes, but flags and names by their kind; TOML has all of them, except bytes and the last three.
WRONG_KINDS = {
    "flag": True,
    "zero": 0,
    "nan": float("nan"),
    "infinity": float("inf"),
    "negative infinity": "-inf",
    "list": [1, [2]],
    "table": {"unit": "um"},
    "date": datetime.date(2020, 1, 1),
    "time": datetime.time(1, 2),
    "empty": "",
    "bytes": b"1um",
    "array": np.ones(2),
    "function": len,
    "operator": rc.half_space(rc.Grid((4, 4), 1e-6), 1e9),
}
NUMBERS = {"zero", "nan", "infinity", "negative infinity"}
# Fields in which any text is a name, and those in which 0 is a value.
NAMES = {
    *("ViscoelasticBody.material", "JointPressure.pressure_field"),
    *("JointMeasurement.file", "JointMeasurement.columns"),
    *("File.file", "File.channel", "InPython.history"),
}
FROM_ZERO = {
    *("OneLoad.depth", "AdhesiveLoad.force", "AdhesiveLoad.pressure", "AdhesiveLoad.depth", "Turn.depth"),
    *("AdhesiveLoads.depths", "AdhesiveLoads.forces", "AdhesiveLoads.pressures"),
    *("FallingLoads.depths", "FallingLoads.forces", "FallingLoads.pressures"),
    *("Bodies.poisson", "Bodies.poisson2", "Theories.hurst", "SelfAffine.hurst", "SelfAffine.seed"),
    *("Specified.hurst", "SpecifiedJoint.hurst", "Specified.seed"),
    *("Fluid.vapour_pressure", "Seal.downstream", "Seal.axis", "LeakAlong.leak", "JointLeak.leak"),
    *("Preparation.form", "Preparation.share", "JointPressure.half_angle"),
}


def test_every_field_is_mutated():
    assert OUT_OF_RANGE.keys() == FIELDS.keys()
    assert BESIDE.keys() | NAMES | FROM_ZERO <= FIELDS.keys()


@pytest.mark.parametrize("field", OUT_OF_RANGE)
def test_a_value_out_of_range_is_refused_and_its_remedy_works(field):
    wrong, *right = OUT_OF_RANGE[field]
    error = refused(with_value(field, wrong))
    assert error.place == place_of(field)
    for value in right:
        assert not isinstance(value, str) or value in error.remedy or field in INSTRUCTED
        job = from_plain(with_value(field, value))
        assert to_plain(from_plain(to_plain(job))) == to_plain(job)
        if "InPython" not in field:
            assert list(calls_of(job))


@pytest.mark.parametrize("field", OUT_OF_RANGE)
@pytest.mark.parametrize("kind", WRONG_KINDS)
def test_a_value_of_a_wrong_kind_is_refused(field, kind):
    each, *_ = FIELDS[field]
    taken = (kind == "flag" and "bool" in str(each.type)) or (kind in NUMBERS and field in NAMES)
    taken |= (kind == "zero" and field in FROM_ZERO) or (kind == "empty" and field == "InPython.history")
    plain = with_value(field, WRONG_KINDS[kind])
    if taken:
        from_plain(plain)
        return
    assert refused(plain).place == place_of(field)
