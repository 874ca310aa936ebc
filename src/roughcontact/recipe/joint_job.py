"""The job of a whole joint: the law of its interface, summed over the pressure on its face."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, ClassVar

from roughcontact.errors import InputError
from roughcontact.files.quantity import ANGLE, FORCE, LENGTH, PRESSURE, VISCOSITY
from roughcontact.recipe.bodies import Bodies, Conduction
from roughcontact.recipe.contact import Contact, pressed
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.plastic_flow import LoopOfLoads, yields_at
from roughcontact.recipe.preparation import Preparation
from roughcontact.recipe.recipe_fields import check, described, require_with, value_of, values_of
from roughcontact.recipe.source import Source
from roughcontact.recipe.texts import Amount, Choice, Likely, PureNumber, sha256, word

__all__ = ["JointJob", "JointLeak", "JointPressure", "JointShear"]

_LENGTH = Likely(Amount(LENGTH), 0.0, 1.0, "larger than a bolt", "mm")
_AMPLITUDE = Likely(Amount(LENGTH), 0.0, 1e-3, "larger than the slip of a joint", "um")
_ANGLE = Amount(ANGLE, "the half angle", positive=False, zero=True)


def _of_bolt(words: str, example: str) -> Any:
    return described(words, example, read=_LENGTH, needs="bolt_force", everyday=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class JointPressure:
    """The pressure on the face: a table, or the cone of a bolt."""

    TITLE: ClassVar = "Pressure on the face (a table, or a bolt)"
    ONE_OF: ClassVar = ("pressure_field", "bolt_force")
    pressure_field: str | None = described(
        "Table of points on a regular grid. Its first line is such as x [mm], y [mm], p [MPa].",
        "field.csv",
        read=word,
        everyday=True,
    )
    sha256: str | None = described(
        "Fingerprint of the table: a different file of the same name is refused.",
        "HEX",
        read=sha256,
        needs="pressure_field",
        option=False,
    )
    bolt_force: str | None = described("Force of a bolt.", "17kN", read=Amount(FORCE), everyday=True)
    head: str | None = _of_bolt("Diameter of its head, or of its washer.", "13mm")
    hole: str | None = _of_bolt("Diameter of the hole.", "9mm")
    thickness: str | None = _of_bolt("Depth of the interface below the head.", "10mm")
    half_angle: str = described(
        "Angle of the cone of pressure to the axis.",
        "30deg",
        read=_ANGLE,
        default="30deg",
        needs="bolt_force",
    )

    def __post_init__(self) -> None:
        check(self)
        require_with(self, "bolt_force", head="13mm", hole="9mm", thickness="10mm")

    def calls(self) -> Iterator[Call]:
        """Yield the call that reads or makes the field."""
        if self.pressure_field is not None:
            given, place = (self.pressure_field,), "pressure.pressure_field"
            yield Call("rc.read_pressure_field", given, result="field", place=place)
            return
        named = {name.removeprefix("bolt_"): value for name, value in values_of(self).items()}
        yield Call("rc.bolt_pressure", (), named, "field", place="pressure", fields={"force": "bolt_force"})


@dataclass(frozen=True, slots=True, kw_only=True)
class JointShear:
    """Friction, and the amplitude of a cycle."""

    TITLE: ClassVar = "Shear"
    friction: str | None = described(
        "Coefficient of friction. The stiffness under shear and torsion is computed, and both bodies are needed.",
        "0.2",
        read=PureNumber(0, 10, "the coefficient of friction", "0.2", ends=False),
        everyday=True,
    )
    amplitude: str | None = described(
        "Amplitude of a tangential displacement, for the loss per cycle and the damping.",
        "1um",
        read=_AMPLITUDE,
        needs="friction",
    )

    def __post_init__(self) -> None:
        check(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class JointLeak:
    """A liquid that leaks between the hole and the outside."""

    TITLE: ClassVar = "Leak"
    leak: str | None = described(
        "Compute the leak between the hole and the outside, by the flow through the map along an axis: 0 down the "
        "picture, along y; 1 along x.",
        read=Choice(("0", "1")),
    )
    viscosity: str | None = described(
        "Dynamic viscosity of the liquid.", "1mPa*s", read=Amount(VISCOSITY), needs="leak"
    )
    drop: str | None = described("Drop of its pressure.", "1bar", read=Amount(PRESSURE), needs="leak")

    def __post_init__(self) -> None:
        check(self)
        require_with(self, "leak", viscosity="1mPa*s", drop="1bar")


@dataclass(frozen=True, slots=True, kw_only=True)
class JointJob:
    """The stiffness of a whole joint from the pressure on its face; its damping, conductance and leak."""

    NAME: ClassVar = "joint"
    source: Source
    pressure: JointPressure
    bodies: Bodies
    shear: JointShear = field(default_factory=JointShear)
    conduction: Conduction = field(default_factory=Conduction)
    leak: JointLeak = field(default_factory=JointLeak)
    plastic: LoopOfLoads = field(default_factory=LoopOfLoads)
    preparation: Preparation = field(default_factory=Preparation)
    contact: Contact = field(default_factory=Contact)

    def __post_init__(self) -> None:
        check(self)
        if self.contact.profile is not None:
            raise InputError("a joint needs a map of heights", "leave `profile` out", "contact.profile")
        if self.shear.friction is not None and self.bodies.modulus is not None:
            raise InputError(
                "`friction` needs Poisson's ratios, which E* does not determine",
                "name both bodies by `materials`, such as steel,aluminium",
                "shear.friction",
            )
        if self.conduction.of == "total":
            words = "a joint has the conductance of its interface"
            raise InputError(words, "leave `of` out", "conduction.of")
        if yields_at(self.bodies, self.plastic) is not None and self.leak.leak is not None:
            words = "`leak` does not go with a hardness: the flow is computed for increasing loads only"
            raise InputError(words, "leave out one of them", "leak.leak")

    def calls(self) -> Iterator[Call]:
        """Yield the calls that make the field and the law, and those of the joint."""
        yield from self.pressure.calls()
        given: tuple[Any, ...] = (Name("surface"),)
        yield Call("rc.hurst_exponent", given, result="wave", attribute="longest_wave", place="source")
        named: dict[str, Any] = {"pressures": Name("field.loads"), **self.contact.named()}
        function, law = "rc.loading_curve", "curve"
        if (hardness := yields_at(self.bodies, self.plastic)) is not None:
            function, law = "rc.loading_loop", "loop"
            named |= {"hardness": hardness, "flow": self.plastic.flow or "removed"}
        if self.leak.leak is not None:
            named["measures"] = [Call("rc.Transmissivity", (), {"axis": int(self.leak.leak)})]
        load = "bolt_force" if self.pressure.pressure_field is None else "pressure_field"
        yield pressed(function, named, law, "pressure", load=load)
        if (friction := value_of(self.shear, "friction")) is None:
            yield Call("rc.normal_law", (Name(law),), result="law", place="pressure")
        else:
            solids = self.bodies.elastic()
            given = (Name(law), solids if len(solids) > 1 else solids[0])
            yield Call("rc.shear_law", given, {"friction": friction}, "law", place="shear")
        given = (Name("law"), Name("field"))
        yield Call("rc.joint", given, {"longest_wave": Name("wave")}, "joint", place="pressure")
        if self.shear.amplitude is not None:
            cycle = {"displacement": value_of(self.shear, "amplitude")}
            for name, result in (("loss", "joint_loss"), ("damping", "damping")):
                fields = {"displacement": "amplitude"}
                yield Call(f"joint.{name}", (), cycle, result, place="shear", fields=fields)
        if conducting := self.conduction.named():
            yield Call("joint.conductance", (), conducting, "conductances", place="conduction")
        if self.leak.leak is not None:
            given = (Name("joint"), Call("rc.Liquid", (value_of(self.leak, "viscosity"),)))
            drop = {"drop": value_of(self.leak, "drop")}
            yield Call("rc.joint_leak", given, drop, "leak_rate", place="leak", fields={"field": "leak"})
