"""The job of a measured joint: its effective height from the stiffness or the closure."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, ClassVar

from roughcontact.errors import InputError
from roughcontact.files.quantity import AREA, COMPLIANCE_AREA, FREQUENCY, IMPEDANCE, LENGTH
from roughcontact.recipe.bodies import Bodies, hardness_of, of_both
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.recipe_fields import check, described, require_with, value_of, values_of
from roughcontact.recipe.texts import METALS, Amount, Choice, Likely, PureNumber, Share, sha256, word

__all__ = ["InferJob", "JointMeasurement", "JointProfile", "MeasuredJoint"]

_OF = {
    "stiffness": ("errors", "gain"),
    "closure": ("resolution", "compliance", "compliance_error"),
    "reflection": ("errors", "gain", "frequency", "impedance"),
}
PLANNED = (1, 2, 4, 8)  # areas of a plan over the given one
_EXPONENT = PureNumber(0.3, 1.2, "the Hurst exponent", "0.8")
_COMPLIANCE = Amount(COMPLIANCE_AREA)
_WAVE = Likely(Amount(FREQUENCY), 1e4, 1e10, "no ultrasound", "MHz")


@dataclass(frozen=True, slots=True, kw_only=True)
class JointMeasurement:
    """A table of pressures and what was measured at them, with errors."""

    TITLE: ClassVar = "Measurement"
    file: str = described(
        "Table of loads: text in columns. The first line is such as pressure [MPa], stiffness [N/um/mm^2], error [%].",
        "FILE",
        read=word,
        default=...,
        everyday=True,
        positional=True,
    )
    columns: str | None = described(
        "Names and units of the columns, in place of the first line of the table.",
        "pressure [MPa], stiffness [N/um/mm^2]",
        read=word,
    )
    quantity: str = described(
        "What was measured: K/A0 without the compliance of the bodies, the closure, or the reflection of ultrasound.",
        read=Choice(tuple(_OF)),
        default="stiffness",
        everyday=True,
    )
    errors: str | None = described(
        "Standard error of a stiffness or a reflection. For a stiffness it is relative (default: the column error "
        "of the table).",
        "5%",
        read=Share("the error"),
        everyday=True,
    )
    gain: str | None = described(
        "Relative standard error that all values share. Such as that of a calibration.",
        "3%",
        read=Share("the gain"),
        everyday=True,
    )
    resolution: str | None = described(
        "Standard error of a closure (default: the column error of the table).",
        "10nm",
        read=Amount(LENGTH, "the resolution"),
        everyday=True,
    )
    compliance: str | None = described(
        "Compliance of machine and bodies between the points of a closure: closure over nominal pressure.",
        "1e-14m/Pa",
        read=_COMPLIANCE,
        everyday=True,
    )
    compliance_error: str | None = described(
        "Standard error of the compliance.", "1e-15m/Pa", read=_COMPLIANCE, needs="compliance"
    )
    frequency: str | None = described("Frequency of the ultrasound.", "2MHz", read=_WAVE, everyday=True)
    impedance: str | None = described(
        "Acoustic impedance of both bodies, or two values for the two bodies: numbers or names of materials "
        "(default: that of the materials).",
        "46MPa*s/m[,...]",
        read=of_both(Amount(IMPEDANCE), "impedance"),
        names=METALS,
        needs="frequency",
    )
    sha256: str | None = described(
        "Fingerprint of the table: a different file of the same name is refused.",
        "HEX",
        read=sha256,
        option=False,
    )

    def __post_init__(self) -> None:
        check(self)
        for name in sorted({name for names in _OF.values() for name in names} - {*_OF[self.quantity]}):
            if getattr(self, name) is not None:
                raise InputError(
                    f"`{name}` has no meaning for a {self.quantity}",
                    "leave it out, or choose another `quantity`",
                    name,
                )
        if self.quantity == "reflection" and self.frequency is None:
            raise InputError(
                "a reflection needs the `frequency` of the wave",
                "give `frequency`, such as 2MHz",
                "frequency",
            )

    def table(self, quantity: str) -> Call:
        """Return the call that reads the table."""
        columns = {} if self.columns is None else {"columns": self.columns}
        return Call("rc.read_joint_table", (self.file, quantity), columns, "table", place="source")

    def calls(self, bodies: Bodies) -> Iterator[Call]:
        """Yield the calls that read the table and make the measurement."""
        yield self.table(self.quantity)
        given = {name: value_of(self, name) for name in _OF[self.quantity]}
        named: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
        error = named.pop("errors" if "errors" in given else "resolution", Name("table.errors"))
        values = (Name("table.pressures"), Name("table.values"), error)
        function = {"stiffness": "rc.JointStiffness", "closure": "rc.JointClosures"}.get(self.quantity)
        if function is None:
            function = "rc.JointStiffness.from_reflection"
            named["impedances"] = named.pop("impedance") if "impedance" in named else _impedances(bodies)
        fields = dict.fromkeys(("pressures", "stiffness", "closures"), "file")
        fields |= {"reflected": "frequency", "error": "errors", "impedances": "impedance"}
        yield Call(function, values, named, "data", place="source", fields=fields)


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredJoint:
    """The joint that was measured."""

    TITLE: ClassVar = "Joint"
    area: str = described("Nominal area.", "2cm^2", read=Amount(AREA, "the area"), default=..., everyday=True)
    branch: str = described(
        "On loading or on unloading.",
        read=Choice(("loading", "unloading")),
        default=...,
        everyday=True,
    )
    modulus_error: str = described(
        "Relative standard error of E*.",
        "2%",
        read=Share("the error of the modulus"),
        default="2%",
        everyday=True,
    )
    hardness: str | None = described(
        "Hardness of the softer face, if it flows. On loading; or the name of its material (default: elastic).",
        "2GPa",
        read=hardness_of,
        names=METALS,
        everyday=True,
    )
    hardness_error: str | None = described(
        "Its relative standard error.", "10%", read=Share("the error"), needs="hardness", everyday=True
    )

    def __post_init__(self) -> None:
        check(self)
        require_with(self, "hardness", hardness_error="10%")


@dataclass(frozen=True, slots=True, kw_only=True)
class JointProfile:
    """The measured topography of both faces together, with errors."""

    TITLE: ClassVar = "Topography (whether this is the joint of it)"
    rms: str | None = described(
        "Rms height of both faces together.", "1.2um", read=Amount(LENGTH, "the rms height"), everyday=True
    )
    rms_error: str | None = described(
        "Its relative standard error.", "10%", read=Share("the error"), needs="rms", everyday=True
    )
    rolloff: str | None = described(
        "Roll-off wavelength.", "100um", read=Amount(LENGTH, "a wavelength"), needs="rms", everyday=True
    )
    rolloff_error: str | None = described(
        "Its relative standard error.", "30%", read=Share("the error"), needs="rms", everyday=True
    )
    hurst: str | None = described("Hurst exponent (default: 0.8).", "0.8", read=_EXPONENT, needs="rms")
    hurst_error: str | None = described(
        "Its standard error (default: 0.15).",
        "0.15",
        read=PureNumber(0, 1, "the error", "0.15", ends=False),
        needs="hurst",
    )
    plan: str | None = described(
        "Plan a measurement: the wanted standard error of the effective height. Prints which areas and numbers of "
        "joints reach it; the table needs pressures only.",
        "5%",
        read=Share("the error"),
        needs="rms",
        everyday=True,
    )

    def __post_init__(self) -> None:
        check(self)
        require_with(self, "rms", rms_error="10%", rolloff="100um", rolloff_error="30%")


@dataclass(frozen=True, slots=True, kw_only=True)
class InferJob:
    """The effective height of a joint from its measured stiffness or closure."""

    NAME: ClassVar = "infer"
    source: JointMeasurement
    bodies: Bodies
    joint: MeasuredJoint
    profile: JointProfile = field(default_factory=JointProfile)

    def __post_init__(self) -> None:
        check(self)
        if (
            self.source.frequency is not None
            and self.source.impedance is None
            and self.bodies.materials is None
        ):
            raise InputError(
                "a reflection needs the acoustic impedances, which E* does not determine",
                "give `impedance`, such as steel,aluminium or 46MPa*s/m",
                "source.impedance",
            )
        if self.profile.plan is None:
            return
        if self.source.quantity != "stiffness":
            raise InputError(
                "a plan is made for stiffnesses", "leave out the `quantity`, or the `plan`", "source.quantity"
            )
        if self.joint.hardness is not None:
            raise InputError(
                "a plan is made for elastic joints",
                "leave out the `hardness`, or the `plan`",
                "joint.hardness",
            )

    def calls(self) -> Iterator[Call]:
        """Yield the calls that read the measurement, and the inference or the plan."""
        planned = self.profile.plan is not None
        yield from (self.source.table("loads"),) if planned else self.source.calls(self.bodies)
        if self.bodies.modulus is None:
            yield Call("rc.reduced_modulus", self.bodies.elastic(), result="modulus", place="bodies")
        else:
            yield from self.bodies.calls()
        named: dict[str, Any] = {"modulus": Name("modulus"), **values_of(self.joint)}
        if planned:
            named = {name: named[name] for name in ("modulus", "modulus_error")}
            named |= {"areas": tuple(times * value_of(self.joint, "area") for times in PLANNED)}
            error = value_of(self.source, "errors")
            named |= {"errors": Name("table.errors") if error is None else error}
            named |= {"gain": value_of(self.source, "gain") or 0.0}
        topography = values_of(self.profile)
        topography.pop("plan", None)
        if topography:
            yield Call("rc.JointTopography", (), topography, "profile", place="profile")
            named["profile"] = Name("profile")
        if planned:
            yield Call(
                "rc.plan_joint", (Name("table.pressures"),), named, "plan", place="joint", doing="Plan"
            )
            return
        yield Call("rc.infer_joint", (Name("data"),), named, "inference", place="joint", doing="Inference")


def _impedances(bodies: Bodies) -> tuple[Call, ...]:
    """Return those of the materials; the library raises an error if one of the bodies is rigid."""
    return tuple(Call("rc.handbook", (name,), attribute="impedance") for name in bodies.elastic())
