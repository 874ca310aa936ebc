"""Options about what flows under a hardness, and the files that show it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from roughcontact.cli.contact.profile_options import ProfileBody, kinds_of
from roughcontact.cli.messages import UsageError, note
from roughcontact.cli.option_groups import option
from roughcontact.cli.output import all_or_none
from roughcontact.cli.report import doing, quantity
from roughcontact.cli.unit_options import parse_load

if TYPE_CHECKING:
    from roughcontact.cli.contact.error_options import Errors
    from roughcontact.cli.options import TwoBodies
    from roughcontact.contact.loop import Loop
    from roughcontact.contact.solution import Solution
    from roughcontact.solver.loads import Loads
    from roughcontact.surface.surface import Surface

__all__ = ["AfterLoad", "LoopLoads", "write_loop"]

FlowChoice = StrEnum("FlowChoice", ["REMOVED", "RAISED"])
_FLOW = option(
    "Under a hardness, where material that flows goes: it vanishes, or raises the whole surface, its volume conserved "
    "(default: removed).",
    needs_whole=True,
)


@dataclass(frozen=True, slots=True)
class AfterLoad:
    """A larger load before the load, and what flowed under it."""

    PANEL: ClassVar = "Plastic flow"
    after: str | None = option(
        "Press by this load first, of the same kind as the load, and unload from there: what has flowed stays. Takes a "
        "--hardness, or --materials.",
        "100N",
        needs_whole=True,
    )
    flow: FlowChoice | None = _FLOW

    @property
    def raises(self) -> bool:
        """Whether what flows raises the surface."""
        return self.flow is FlowChoice.RAISED

    def hardness(self, bodies: TwoBodies) -> float | None:
        """Return the hardness [Pa], which is that of the softer material where a load comes before and none is given.

        Raises
        ------
        UsageError
            If it is not given, and something is asked about what flows.
        """
        return _hardness(bodies, "--after" if self.after is not None else None, self.flow)

    def first(self, given: Mapping[str, float], body: ProfileBody | None) -> float | None:
        """Return the load that comes first, in SI units.

        Raises
        ------
        UsageError
            If it is not larger than the load itself.
        """
        if self.after is None:
            return None
        [(name, load)] = given.items()
        first = parse_load(self.after, kinds_of(body)[name], "--after")
        if first <= load:
            raise UsageError(
                f"--after {self.after} is not larger than the {name}, so that nothing is unloaded",
                "leave it out, or exchange the two",
                place="--after",
            )
        return first

    def check(self, errors: Errors) -> None:
        """Refuse errors of what no single load is.

        Raises
        ------
        UsageError
            If they are asked for.
        """
        if errors.errors and (self.after is not None or self.raises):
            asked = "--after" if self.after is not None else "--flow raised"
            raise UsageError(
                "--errors presses other maps by the same load alone",
                f"leave it out with {asked}",
                place="--errors",
            )

    def last_of(
        self,
        surface: Surface,
        modulus: float,
        given: Mapping[str, float],
        first: float | None,
        limits: Mapping[str, Any],
    ) -> Solution:
        """Return the state under the load, after the one that comes first."""
        import roughcontact as rc

        [(name, load)] = given.items()
        loads: dict[str, Any] = {f"{name}s": [load] if first is None else [first, load]}
        with doing("Pressing and unloading"):
            *_, last = rc.loading_path(surface, modulus, **loads, flow=_reading(self.flow), **limits)
        return last

    def draw(self, surface: Surface, solution: Solution, folder: Path, ending: str) -> tuple[str, ...]:
        """Draw the surface as it was and as it is, where it has flowed under an earlier load."""
        from roughcontact.plot.canvas import save
        from roughcontact.plot.loops import flattened_figure

        flow = solution.problem.flow
        if flow is None:
            return ()
        with all_or_none(folder) as aside:
            save(flattened_figure(surface, flow), aside / f"flattened.{ending}")
        return ("flattened",)


@dataclass(frozen=True, slots=True)
class LoopLoads:
    """Whether the loads go down and up again."""

    PANEL: ClassVar = "Plastic flow"
    loop: bool = option(
        "Press for the first time, unload and press again: depth and stiffness of all three, and the flattened "
        "surface. Takes a --hardness, or --materials.",
        default=False,
        needs_whole=True,
    )
    flow: FlowChoice | None = _FLOW

    @property
    def reading(self) -> Any:
        """Where material that flows goes, as the library calls it."""
        return _reading(self.flow)

    def hardness(self, bodies: TwoBodies) -> float | None:
        """Return the hardness [Pa], which is that of the softer material for a loop where none is given.

        Raises
        ------
        UsageError
            If it is not given, and something is asked about what flows.
        """
        return _hardness(bodies, "--loop" if self.loop else None, self.flow)

    def check(self, loads: Loads | None, errors: Errors) -> None:
        """Refuse loads that no loop has, and errors of a surface that rises.

        Raises
        ------
        UsageError
            If the loads are depths, and a loop or a rise is asked for; or a rise and errors.
        """
        if errors.errors and self.flow is FlowChoice.RAISED:
            raise UsageError(
                "--errors presses other maps by the same load alone",
                "leave it out with --flow raised",
                place="--errors",
            )
        if loads is not None and loads.kind == "depth" and (self.loop or self.flow is FlowChoice.RAISED):
            asked = "--loop" if self.loop else "--flow raised"
            raise UsageError(f"{asked} goes by forces or pressures: the depth is what is found")

    def up_and_down(self, loads: Loads) -> Loads:
        """Return the loads in the order in which they come."""
        from roughcontact.contact.loop import loads_of_loop

        return loads_of_loop(loads) if self.loop else loads


def write_loop(loop: Loop, folder: Path, source: Mapping[str, Any], ending: str) -> tuple[str, ...]:
    """Write a loop and the flattened surface into a folder, all files or none; return their names."""
    from roughcontact.files.save import write
    from roughcontact.files.write import write_csv, write_netcdf
    from roughcontact.plot.canvas import save
    from roughcontact.plot.loops import flattened_figure, loop_figure
    from roughcontact.surface.surface import Surface

    dataset = loop.to_dataset()
    with all_or_none(folder) as aside:
        write_netcdf(dataset, aside / "loop.nc", source)
        write_csv(dataset, aside / "loop.csv", source)
        save(loop_figure(loop), aside / f"loop.{ending}")
        save(flattened_figure(loop.surface, loop.flow), aside / f"flattened.{ending}")
        if isinstance(loop.flattened, Surface):
            write(loop.flattened, aside / "flattened.npz")
    return "loop.nc", "loop.csv", f"loop.{ending}", f"flattened.{ending}", "flattened.npz"


def _reading(flow: FlowChoice | None) -> Any:
    return FlowChoice.REMOVED.value if flow is None else flow.value


def _hardness(bodies: TwoBodies, asked: str | None, flow: FlowChoice | None) -> float | None:
    """Return the hardness that was given; else, where flow is asked for, that of the softer material."""
    given = bodies.yield_pressure()
    asked = asked or (None if flow is None else "--flow")
    if given is not None or asked is None:
        return given
    softer = bodies.softer()
    if softer is None:
        raise UsageError(f"{asked} is about what flows", "give a --hardness, or both bodies by --materials")
    note(f"the hardness is that {softer[1]}: {quantity('hardness', softer[0])}")
    return softer[0]
