"""The options ``--errors`` and ``--short-cutoff``: an error on every number of a load, and what it is made of."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import typer

from roughcontact.cli.messages import UsageError, note
from roughcontact.cli.option_groups import option
from roughcontact.cli.report import doing, print_facts, print_table, quantity
from roughcontact.cli.unit_options import LENGTH, parse_positive
from roughcontact.plot.drawing.engineering_units import Scale, scale

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution
    from roughcontact.evaluation.error_budget import ErrorBudget
    from roughcontact.surface.surface import Surface

__all__ = ["Errors", "LoadErrors"]

_PATCH = (
    *("depth", "force", "stiffness", "interfacial_stiffness", "contact_area", "corrected_contact_area"),
    "elastic_energy",
)
_JOINT = ("interfacial_stiffness_per_area", "contact_fraction", "corrected_contact_fraction")


@dataclass(frozen=True, slots=True)
class LoadErrors:
    """The errors of one load."""

    force: float
    budget: ErrorBudget

    def to_record(self) -> dict[str, Any]:
        """Return them as plain values."""
        return {"force": self.force, **self.budget.to_record()}

    def tell(self, units: Mapping[str, Scale], *, patch: bool, joint: bool) -> None:
        """Print the numbers of a patch, those of a joint, or both, with their errors, and what each source is."""
        names = (*(_PATCH if patch else ()), *(_JOINT if joint else ()), "mean_gap")

        def in_unit(name: str, value: float) -> tuple[float, str]:
            suits = units.get(name) or scale(abs(value), self.budget[name].unit)
            return suits.factor, suits.unit

        typer.echo(f"\nerrors at {quantity('force', self.force)}")
        print_table(*self.budget.table(names, in_unit))
        print_facts([(source.name, f"{source.kind}: {source.how}") for source in self.budget.sources])
        for line in self.budget.notes:
            note(line)


@dataclass(frozen=True, slots=True)
class Errors:
    """Whether errors are wanted, and what the instrument records."""

    PANEL: ClassVar = "Errors"
    errors: bool = option(
        "An error on every number, and what it is made of: half as many cells, no short waves, other levelling. "
        "As long as two or three loads more; of a curve at its first and last resolved load.",
        default=False,
        needs_whole=True,
    )
    short_cutoff: str | None = option(
        "With --errors: the shortest wave that the instrument records (default: four cells).", "5um"
    )

    def check(self) -> None:
        """Refuse a cut-off without --errors, or one that is none, before any work."""
        if self.short_cutoff is not None and not self.errors:
            raise UsageError(
                "--short-cutoff belongs to --errors",
                "to filter a map take 'surface prepare'",
                place="--short-cutoff",
            )
        self._cutoff()

    def check_for(self, surface: Surface) -> None:
        """Refuse a surface or a cut-off that errors are not known for, before it is pressed."""
        if not self.errors:
            return
        if surface.grid.ndim != 2:
            raise UsageError(
                "--errors are those of a map of heights, not of a profile", "leave it out", place="--errors"
            )
        from roughcontact.evaluation.error_sources import checked_cutoff

        checked_cutoff(surface, self._cutoff())

    def of(self, solutions: Iterable[Solution]) -> tuple[LoadErrors, ...]:
        """Return the errors of loads, if they are wanted; a note says where there are none, and why."""
        if not self.errors:
            return ()
        from roughcontact.contact.convergence import ConvergenceError
        from roughcontact.evaluation.error_sources import error_budget

        found = []
        for solution in solutions:
            at = quantity("force", solution.force)
            with doing(f"Errors at {at}: half the cells, no short waves, other levelling"):
                try:
                    budget = error_budget(solution, short_cutoff=self._cutoff())
                except ConvergenceError as error:
                    note(f"no errors at {at}: {error}")
                    continue
            found.append(LoadErrors(solution.force, budget))
        return tuple(found)

    def _cutoff(self) -> float | None:
        text = self.short_cutoff
        return None if text is None else parse_positive(text, LENGTH, "--short-cutoff", "a wavelength")
