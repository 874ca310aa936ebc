"""An error on every number of a load, and its sources."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.cli.messages import note
from roughcontact.cli.report import print_facts, print_table, quantity
from roughcontact.errors import placed
from roughcontact.labels.engineering_units import Scale, scale
from roughcontact.recipe.recipe_fields import value_of

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution
    from roughcontact.evaluation.error_budget import ErrorBudget
    from roughcontact.labels.note import Note
    from roughcontact.recipe.outputs import Errors
    from roughcontact.surface.surface import Surface

__all__ = ["LoadErrors", "errors_of", "notes_on_errors", "require_errors"]

_PATCH = (
    *("depth", "force", "stiffness", "interfacial_stiffness", "contact_area", "corrected_contact_area"),
    "elastic_energy",
)
_JOINT = ("interfacial_stiffness_per_area", "contact_fraction", "corrected_contact_fraction")


@dataclass(frozen=True, slots=True)
class LoadErrors:
    """The errors of one load."""

    force: float
    pressure: float
    budget: ErrorBudget

    def to_record(self) -> dict[str, Any]:
        """Return them as plain values."""
        return {"force": self.force, **self.budget.to_record()}

    def tell(self, units: Mapping[str, Scale], *, patch: bool, joint: bool) -> None:
        """Print the numbers of a patch, those per area, or both, with their errors and the sources of these."""
        names = (*(_PATCH if patch else ()), *(_JOINT if joint else ()), "mean_gap")

        def in_unit(name: str, value: float) -> tuple[float, str]:
            suits = units.get(name) or scale(abs(value), self.budget[name].unit)
            return suits.factor, suits.unit

        unit = units.get("nominal_pressure") or scale(self.pressure, "Pa")
        pressure = f"{self.pressure * unit.factor:.4g} {unit.unit}"
        typer.echo(f"\nerrors at {quantity('force', self.force)}, nominal pressure {pressure}")
        print_table(*self.budget.table(names, in_unit))
        print_facts(self.budget.facts())


def notes_on_errors(errors: Iterable[LoadErrors]) -> list[Note]:
    """Return the notes on the errors, with the load if there are several."""
    from roughcontact.labels.note import Note, Rank

    found = tuple(errors)
    loads = [f"at {quantity('force', each.force)}: " if len(found) > 1 else "" for each in found]
    pairs = zip(loads, found, strict=True)
    return [Note(Rank.LIMITED, f"{load}{line}") for load, each in pairs for line in each.budget.notes]


def require_errors(asked: Errors, surface: Surface) -> None:
    """Raise an error before the work if no errors can be given for a surface, a shortest wave or a noise."""
    if not asked.errors:
        return
    import roughcontact
    from roughcontact.evaluation.error_sources import checked_cutoff
    from roughcontact.evaluation.noise import require_fits

    with placed("errors.shortest_wave"):
        checked_cutoff(surface, value_of(asked, "shortest_wave"))
    if (noise := asked.call().named.get("noise")) is not None:
        with placed("errors.noise_length"):
            require_fits(noise.value({"rc": roughcontact}), surface.grid)


def errors_of(asked: Errors, solutions: Iterable[Solution]) -> tuple[LoadErrors, ...]:
    """Return the errors of loads, if the job asks for them; print a note for each load without errors."""
    if not asked.errors:
        return ()
    import roughcontact
    from roughcontact.contact.convergence import ConvergenceError

    found = []
    for solution in solutions:
        at = quantity("force", solution.force)
        try:
            budget = asked.call().value({"rc": roughcontact, "solution": solution})
        except ConvergenceError as error:
            note(f"no errors at {at}: {error}")
            continue
        found.append(LoadErrors(solution.force, solution.nominal_pressure, budget))
    return tuple(found)
