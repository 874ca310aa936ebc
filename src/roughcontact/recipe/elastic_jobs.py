"""Jobs without adhesion: heights, one load, increasing loads or a loop of loads."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

from roughcontact.errors import InputError, within
from roughcontact.recipe.bodies import Bodies, Conduction
from roughcontact.recipe.contact import Contact, pressed
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.measured.heat_parts import HeatParts
from roughcontact.recipe.measured.incident_wave import Ultrasound
from roughcontact.recipe.measured.leak_along import LeakAlong
from roughcontact.recipe.outputs import Errors, InterfaceTables, PressureTheory, Theories, Units
from roughcontact.recipe.plastic_flow import AfterLoad, LoopOfLoads, yields_at
from roughcontact.recipe.preparation import Preparation
from roughcontact.recipe.prescribed_loads import OneLoad, RisingLoads, kinds_of, one_load
from roughcontact.recipe.recipe_fields import check, given
from roughcontact.recipe.source import Source

__all__ = ["CurveJob", "PressJob", "SurfaceJob"]


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfaceJob:
    """Heights, prepared."""

    NAME: ClassVar = "surface"
    source: Source
    preparation: Preparation = field(default_factory=Preparation)

    def __post_init__(self) -> None:
        check(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class PressJob:
    """One load: pressure map, area, depth and stiffness."""

    NAME: ClassVar = "press"
    source: Source
    load: OneLoad
    bodies: Bodies
    preparation: Preparation = field(default_factory=Preparation)
    contact: Contact = field(default_factory=Contact)
    plastic: AfterLoad = field(default_factory=AfterLoad)
    errors: Errors = field(default_factory=Errors)
    theories: PressureTheory = field(default_factory=PressureTheory)
    units: Units = field(default_factory=Units)

    def __post_init__(self) -> None:
        check(self)
        self.loads()
        yields_at(self.bodies, self.plastic)
        _require_areas(self)
        asked = next(
            (name for name in ("after", "flow") if getattr(self.plastic, name) not in (None, "removed")), None
        )
        if self.errors.errors and asked:
            raise InputError(
                f"`errors` does not go with `{asked}`: other maps are pressed by the same load only",
                "leave out one of them",
                "errors.errors",
            )
        if self.theories.theory and self.contact.profile:
            raise InputError(
                "`theory` predicts pressures of a surface, not of a profile",
                "leave it out",
                "theories.theory",
            )

    def loads(self) -> dict[str, Any]:
        """Return the load in SI by name, or the two loads of a path if a larger one comes first."""
        with within("load"):
            given = self.load.named(self.contact.profile)
        [(name, load)] = given.items()
        if self.plastic.after is None:
            return given if self.plastic.flow != "raised" else {f"{name}s": [load]}
        with within("plastic"):
            first = one_load(self.plastic.after, kinds_of(self.contact.profile)[name], "after")
            if first <= load:
                raise InputError(
                    f"`after` {self.plastic.after} is not larger than the {name}",
                    "leave it out, or exchange the two loads",
                    "after",
                )
        return {f"{name}s": [first, load]}

    def calls(self) -> Iterator[Call]:
        """Yield the calls that press."""
        loads = self.loads()
        path = loads.keys().isdisjoint(("force", "pressure", "depth"))
        named = {**loads, **_hardness(self), **({"flow": "raised"} if self.plastic.flow == "raised" else {})}
        function, result = ("rc.loading_path", "*_, solution") if path else ("rc.press", "solution")
        yield pressed(function, named | self.contact.named(), result, "load")
        if self.errors.errors:
            yield self.errors.call()


@dataclass(frozen=True, slots=True, kw_only=True)
class CurveJob:
    """Increasing loads, or a loop of loads: stiffness, area and more against force or pressure."""

    NAME: ClassVar = "curve"
    source: Source
    bodies: Bodies
    loads: RisingLoads = field(default_factory=RisingLoads)
    preparation: Preparation = field(default_factory=Preparation)
    contact: Contact = field(default_factory=Contact)
    plastic: LoopOfLoads = field(default_factory=LoopOfLoads)
    conduction: Conduction = field(default_factory=Conduction)
    heat: HeatParts = field(default_factory=HeatParts)
    ultrasound: Ultrasound = field(default_factory=Ultrasound)
    theories: Theories = field(default_factory=Theories)
    errors: Errors = field(default_factory=Errors)
    leak: LeakAlong = field(default_factory=LeakAlong)
    tables: InterfaceTables = field(default_factory=InterfaceTables)
    units: Units = field(default_factory=Units)

    def __post_init__(self) -> None:
        check(self)
        with within("loads"):
            self.loads.named(self.contact.profile)
        yields_at(self.bodies, self.plastic)
        _require_areas(self)
        asked = "loop" if self.plastic.loop else "flow" if self.plastic.flow == "raised" else None
        if self.errors.errors and self.plastic.flow == "raised":
            raise InputError(
                "`errors` does not go with `flow` raised: other maps are pressed by the same load only",
                "leave out one of them",
                "errors.errors",
            )
        if asked and self.loads.depths is not None:
            raise InputError(
                f"`{asked}` needs forces or pressures, because the depth is computed",
                "give `forces`",
                "loads.depths",
            )
        if self.leak.leak is not None and (self.plastic.loop or self.contact.profile is not None):
            other = "loop" if self.plastic.loop else "profile"
            why = "is computed for increasing loads only" if other == "loop" else "needs a map of heights"
            raise InputError(
                f"`leak` does not go with `{other}`: the flow {why}", "leave out one of them", "leak.leak"
            )
        if self.heat.named():
            self._require_heat()
        profile, conducts = self.contact.profile, bool(self.conduction.named())
        if conducts and profile == "line":
            raise InputError(
                "the conductance of a line contact is undetermined: it depends on the size of the bodies",
                "leave out `resistivity` and `conductivity`",
                "conduction",
            )
        if conducts and profile == "winkler" and self.conduction.of == "interface":
            raise InputError(
                "a Winkler foundation only has a total conductance", "give `of` total", "conduction.of"
            )
        self.ultrasound.require(self.bodies, profile)
        self.tables.require(self.bodies)
        _require_known(self.theories.names(), self.theories.known() | _hardness(self))

    def _require_heat(self) -> None:
        """Raise an error if the conductance by parts cannot be computed."""
        asked = " and ".join(f"`{name}`" for name in given(self.heat))
        beside = (
            ("loop", self.plastic.loop, "plastic"),
            ("profile", self.contact.profile is not None, "contact"),
            ("of", self.conduction.of == "total", "conduction"),
        )
        for name, contradicts, part in beside:
            if contradicts:
                raise InputError(
                    f"{asked} does not go with `{name}`",
                    f"leave {'`of`' if name == 'of' else asked} out",
                    f"{part}.{name}",
                )
        if self.conduction.conductivity is None:
            raise InputError(
                f"{asked} needs the conductivity of the bodies",
                "give `conductivity`, such as 400W/m/K or steel,aluminium",
                "conduction.conductivity",
            )
        if 0 in self.conduction.named()["conductivities"]:
            raise InputError(
                "an insulator has no conductance",
                "give conductivities above 0, such as 400W/m/K",
                "conduction.conductivity",
            )

    def measures(self) -> list[Call]:
        """Return the calls that make the functions of a state whose numbers become columns of the curve."""
        found = self.leak.measures()
        if heat := self.heat.named():
            pair = {"conductivities": self.conduction.named()["conductivities"]}
            found.append(Call("rc.ConductanceParts", (), pair | heat, place="heat"))
        return found

    def calls(self) -> Iterator[Call]:
        """Yield the calls that follow the loads, and those that evaluate the curve."""
        loads = self.loads.named(self.contact.profile)
        flow = {} if self.plastic.flow in (None, "removed") else {"flow": self.plastic.flow}
        measures = {"measures": found} if (found := self.measures()) else {}
        named = {**loads, **_hardness(self), **flow, **self.contact.named(), **measures}
        function, result = ("rc.loading_loop", "loop") if self.plastic.loop else ("rc.loading_curve", "curve")
        yield pressed(function, named, result, "loads")
        curve = "loop.loading" if self.plastic.loop else "curve"
        if names := self.theories.names():
            known = self.theories.known() | _hardness(self)
            given = (Name("surface"), Name("modulus"), list(names))
            yield Call("rc.loading_laws", given, known, result="theories", place="theories")
        conducting = self.conduction.named()
        if conducting:
            of = {} if self.conduction.of == "interface" else {"of": self.conduction.of}
            yield _call("rc.conductance", curve, conducting | of, "conductance")
        yield from self.ultrasound.calls(curve, self.bodies)
        yield from self.tables.calls(curve, self.bodies, conducting)


def _require_areas(job: PressJob | CurveJob) -> None:
    profile = job.contact.profile
    if job.errors.errors and profile is not None:
        raise InputError(
            "`errors` are those of a map of heights, not of a profile", "leave it out", "errors.errors"
        )
    depth = job.load.depth if isinstance(job, PressJob) else job.loads.depths
    if job.errors.noise is not None and depth is not None:
        raise InputError(
            "`noise` needs a force or a pressure: depth counts from the highest cell, so at a given depth the load "
            "follows the noise of this cell",
            "give `pressure`, or leave out `noise`",
            "errors.noise",
        )
    if job.plastic.hardness is not None and profile == "winkler":
        raise InputError(
            "`hardness` is a pressure, but springs have forces per length",
            "leave it out, or take `profile` line",
            "plastic.hardness",
        )
    if profile == "winkler" and (job.units.unit_stiffness or job.units.unit_pressure):
        raise InputError(
            "`unit_stiffness` and `unit_pressure` are per area: on springs loads and stiffness are per length",
            "leave them out",
            "units.unit_stiffness, units.unit_pressure",
        )


def _require_known(theories: Sequence[str], known: Mapping[str, Any]) -> None:
    """Raise an error for theories that need a number that is not given and that a surface does not determine."""
    if not theories:
        return
    from roughcontact.theory.laws import LAWS  # late, with NumPy

    for need, part, example in (("radius", "theories", "5mm"), ("hardness", "plastic", "2GPa or aluminium")):
        for name in theories:
            if need in LAWS[name].needs and need not in known:
                raise InputError(
                    f"`theory` {name} needs a {need}, which cannot be measured on the surface",
                    f"give `{need}`, such as {example}",
                    f"{part}.{need}",
                )


def _hardness(job: PressJob | CurveJob) -> dict[str, Any]:
    hardness = yields_at(job.bodies, job.plastic)
    return {} if hardness is None else {"hardness": hardness}


def _call(function: str, of: str, named: Mapping[str, Any], result: str) -> Call:
    left = {name: value for name, value in named.items() if value is not None}
    return Call(function, (Name(of),), left, result=result, place=result)
