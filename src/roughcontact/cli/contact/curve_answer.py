"""The answer of the command ``curve``: on the screen, as JSON, and in files."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughcontact.cached import cached_property
from roughcontact.cli import report
from roughcontact.cli.contact.conductance_command import conduction_facts, shown_columns
from roughcontact.cli.contact.curve_theories import deviations, exponents, parameters
from roughcontact.cli.contact.load_errors import notes_on_errors
from roughcontact.cli.contact.units_of_job import units_of_job
from roughcontact.cli.contact_of_job import name_of
from roughcontact.cli.messages import note_all, worded
from roughcontact.cli.output import all_or_none, command_line
from roughcontact.errors import InputError
from roughcontact.recipe.jobs import known_names
from roughcontact.recipe.recipe_fields import given, value_of
from roughcontact.recipe.written import carried

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from roughcontact.cli.contact.curve_theories import TheoriesOf
    from roughcontact.cli.contact.load_errors import LoadErrors
    from roughcontact.cli.pressed import Pressed
    from roughcontact.contact.compare import Comparison
    from roughcontact.contact.curve import Curve
    from roughcontact.contact.loop import Loop
    from roughcontact.evaluation.conduction import Conductors
    from roughcontact.labels.engineering_units import Scale
    from roughcontact.labels.note import Note
    from roughcontact.recipe.elastic_jobs import CurveJob
    from roughcontact.recipe.job_calls import Call
    from roughcontact.solver.loads import Loads
    from roughcontact.statistics.power_law import PowerLaw
    from roughcontact.surface.surface import Surface
    from roughcontact.theory.law import LoadingLaw

__all__ = ["CurveAnswer"]


@dataclass(frozen=True)
class CurveAnswer:
    """A computed curve with its notes, theories, conductors and errors.

    Parameters
    ----------
    job : CurveJob
        The job.
    curve : Curve
    surface : Surface
        The surface that was pressed.
    notes : tuple of Note
        On loads that are not computed.
    theories : TheoriesOf
        Of the surface.
    conductors : Conductors or None
        The conducting bodies.
    per_area : bool
        Whether table and picture are per area, against nominal pressure.
    errors : tuple of LoadErrors
        Errors of the first and the last resolved load, if they were asked for.
    pressed : Pressed
        The kind of the surface, and its plasticity index.
    loads : Loads
        Those of the curve.
    out : Path or None
        The folder of its files.
    loop : Loop or None
        First loading, which is the curve, followed by unloading and reloading.
    """

    job: CurveJob
    curve: Curve
    surface: Surface
    notes: tuple[Note, ...]
    theories: TheoriesOf
    conductors: Conductors | None
    per_area: bool
    errors: tuple[LoadErrors, ...]
    pressed: Pressed
    loads: Loads
    out: Path | None
    loop: Loop | None

    @cached_property
    def tolerance(self) -> float:
        """The required tolerance."""
        return float(value_of(self.job.contact, "tolerance"))

    @cached_property
    def units(self) -> dict[str, Scale]:
        """The units that the job names, by column."""
        return units_of_job(self.job.units)

    @property
    def picture(self) -> str:
        """The name of its picture, without the ending: a loop has a second one of all branches."""
        return "curve" if self.loop is None else "first_loading"

    @property
    def converged(self) -> bool:
        """Whether every load met the tolerance."""
        return all(status.converged for status in self.curve.status)

    @property
    def fit(self) -> PowerLaw | None:
        """The power law through the resolved points, if they allow one."""
        return self._fitted[0]

    @cached_property
    def _fitted(self) -> tuple[PowerLaw | None, str]:
        """The power law, or the reason why none is fitted."""
        try:
            return self.curve.fit(), ""
        except InputError as error:
            return None, str(error)

    @cached_property
    def comparisons(self) -> dict[str, Comparison]:
        """The curve beside each theory that applies."""
        return self._compared[0]

    @property
    def drawn(self) -> tuple[LoadingLaw, ...]:
        """The theories that apply, with their quantities, by the names in the job."""
        return tuple(
            replace(
                law,
                name=key,
                quantities={name: law.quantities[name] for name in self.comparisons[key].predicted},
            )
            for key, law in self.theories.laws.items()
            if key in self.comparisons
        )

    @cached_property
    def recipe(self) -> dict[str, Any]:
        """The job, with file names that count from the folder of the answer."""
        return carried(self.job, self.out)

    @property
    def left_out(self) -> dict[str, str]:
        """Why a theory is left out, by its name."""
        return {**self.theories.refused, **self._compared[1]}

    @cached_property
    def _compared(self) -> tuple[dict[str, Comparison], dict[str, str]]:
        found: dict[str, Comparison] = {}
        failed: dict[str, str] = {}
        for key, law in self.theories.laws.items():
            try:
                found[key] = self.curve.compare(law)
            except InputError as error:
                failed[key] = str(error)
        return found, failed

    @cached_property
    def dataset(self) -> xarray.Dataset:
        """The curve with the columns of theories, conductance and ultrasound, in the units that the job names."""
        from roughcontact.contact.compare import with_theories
        from roughcontact.contact.dataset import curve_dataset
        from roughcontact.contact.loop_dataset import unloaded
        from roughcontact.evaluation.conduction import with_conductance

        dataset = with_theories(curve_dataset(self.curve), self.comparisons)
        if self.conductors is not None:
            dataset = with_conductance(dataset, self.conductors, self.job.conduction.of)
        for call in self._reflection:
            dataset = call.value(known_names() | {"dataset": dataset})
        if self.loop is not None:
            dataset = dataset.assign(unloaded(self.loop))
        return dataset.assign(
            {name: _in_unit(dataset[name], unit) for name, unit in self.units.items() if name in dataset}
        )

    @property
    def _reflection(self) -> list[Call]:
        """The call that adds the reflection of ultrasound to the dataset, if the job names a frequency."""
        return list(self.job.ultrasound.calls("dataset", self.job.bodies))

    @cached_property
    def record(self) -> dict[str, Any]:
        """The answer as plain values."""
        from roughcontact.contact.dataset import curve_record
        from roughcontact.labels.column import names_of
        from roughcontact.labels.contact_columns import CONDUCTION, CONDUCTION_PER_AREA, REFLECTION
        from roughcontact.labels.labelled import plain_values
        from roughcontact.labels.note import in_order

        conducted = {
            name: self.dataset[name]
            for name in names_of(CONDUCTION + CONDUCTION_PER_AREA + REFLECTION)
            if name in self.dataset
        }
        record = {
            "command": self.job.NAME,
            "file": name_of(self.job.source),
            "surface": list(self.surface.provenance),
            **self.pressed.record(),
            **curve_record(self.curve),
            **{name: plain_values(values.to_numpy()) for name, values in conducted.items()},
            "fit": None if self.fit is None else _fit_record(self.fit),
            "local_exponents": [asdict(each) for each in self.curve.local_exponents()],
            "theory_parameters": dict(self.theories.taken),
            "theories_left_out": self.left_out,
            "theories": {key: each.to_record() for key, each in self.comparisons.items()},
            "errors": [each.to_record() for each in self.errors],
            "tolerance": self.tolerance,
            "converged": self.converged,
            "doubtful": list(self.curve.doubts),
            "notes": list(in_order(self._of_states)),
            "loads": {f"{self.loads.kind}s": self.loads.values.tolist()},
            "recipe": self.recipe,
        }
        if self.loop is not None:
            record["loop"] = self.loop.to_record()
        record["units"] |= {
            name: values.attrs["units"] for name, values in conducted.items() if "units" in values.attrs
        }
        return record

    def source(self, control: str) -> dict[str, Any]:
        """Return the provenance that files contain."""
        from roughcontact.files.provenance import provenance

        return provenance(
            self.surface,
            modulus=self.curve.modulus,
            control=control,
            tolerance=self.tolerance,
            command=command_line(),
            recipe=self.recipe,
        )

    def write(self, folder: Path, source: dict[str, Any], ending: str) -> tuple[str, ...]:
        """Write NetCDF, CSV, pictures (by their `ending`) and summary into a folder: all of them or none.

        Return the names of further pictures.
        """
        from matplotlib.figure import Figure

        from roughcontact.files.write import write_csv, write_json, write_netcdf
        from roughcontact.plot.canvas import save
        from roughcontact.plot.flows.conductance_plot import conductance_curve
        from roughcontact.plot.flows.leak_plot import leak_curve

        drawn: dict[str, Any] = {}
        if self.job.leak.leak is not None:
            drawn[f"leak.{ending}"] = leak_curve
        if self.job.heat.named():
            drawn[f"conductance_parts.{ending}"] = conductance_curve

        with all_or_none(folder) as aside:
            write_netcdf(self.dataset, aside / "curve.nc", source)
            write_csv(self.dataset, aside / "curve.csv")
            figure = self._figure()
            if self.loop is not None:
                figure.suptitle("first loading")
            save(figure, aside / f"{self.picture}.{ending}")
            for name, draw in drawn.items():
                figure = Figure(figsize=(5.6, 4.2), layout="constrained")
                draw(self.curve, figure.subplots(), units=self.units)
                save(figure, aside / name)
            write_json(self.record, aside / "curve.json", source)
        return tuple(drawn)

    def tell(self, json: bool) -> None:
        """Print the answer on standard output, and its notes on standard error."""
        from roughcontact.labels.column import names_of, shown_in
        from roughcontact.labels.contact_columns import REFLECTION
        from roughcontact.labels.variables import VARIABLES
        from roughcontact.plot.facts import AREAL_COLUMNS, CURVE_COLUMNS

        curve = self.curve
        if json:
            report.emit(self.record)
        else:
            modulus = report.quantity("modulus", curve.modulus)
            size = report.size_of(self.surface.grid)
            doubts = [("doubtful", worded(line)) for line in curve.doubts]
            report.print_facts(
                [*doubts, ("surface", size), *self.pressed.facts(), ("reduced modulus E*", modulus)]
            )
            columns = AREAL_COLUMNS if self.per_area else CURVE_COLUMNS
            measured = [name for name in curve.measured if "joint" in VARIABLES[name].shown.split()]
            conducted = shown_columns(self.dataset)
            if self.job.heat.named():  # the joint in place of bare spots in vacuum, and only the parts it has
                conducted = [name for name in conducted if not name.startswith("thermal")]
                left = {f"{part}_conductance_per_area" for part in ("gas", "radiation")}
                measured = [name for name in measured if name not in left or curve.measured[name].any()]
            # In elastic contact the stiffness on unloading is K/A0, which stands in the table already.
            reflected = names_of(shown_in("joint", REFLECTION))[curve.flow is None :]
            shown = (*columns, *measured, *conducted, *reflected)
            report.print_table(*report.load_table(self.dataset, shown))
            conducting = (
                []
                if self.conductors is None
                else conduction_facts(self.dataset, self.conductors, self.job.conduction.of)
            )
            conducting += given(self.job.heat).items()
            local = exponents(curve, self.comparisons)
            facts = [*report.curve_facts(curve, self.fit), *local, *conducting, *self._waves()]
            report.print_facts(facts)
            if self.comparisons:
                report.print_facts([*deviations(self.comparisons), *parameters(self.theories.taken)])
            if self.loop is not None:
                report.print_facts(report.loop_facts(self.loop))
            for each in self.errors:
                each.tell(self.units, patch=not self.per_area, joint=self.per_area)
        note_all([*self._notes(), *notes_on_errors(self.errors), *self._of_states])

    @property
    def _of_states(self) -> tuple[Note, ...]:
        """The notes on the states, and on loads that are not computed."""
        from roughcontact.contact.notes.curve_notes import curve_notes
        from roughcontact.evaluation.reflection import reflection_notes

        seen = [note for call in self._reflection for note in reflection_notes(self.dataset, call.given[-1])]
        return (*curve_notes(self.curve), *seen, *self.notes)

    def _waves(self) -> Iterator[tuple[str, str]]:
        """Yield the lines on the waves in both bodies."""
        from roughcontact.evaluation.reflection import waves_of

        for call in self._reflection:
            (_, bodies, frequency), named = call.arguments(known_names() | {"dataset": None})
            impedances, speeds = waves_of(bodies, **named)
            lengths = (report.quantity("lengths", speed / frequency) for speed in speeds)
            if self.curve.hardness < math.inf:
                yield "reflection", "by the stiffness on unloading, because a small oscillation is elastic"
            yield "impedances", f"{impedances[0] / 1e6:.3g} and {impedances[1] / 1e6:.3g} MPa s/m"
            yield "wavelengths", " and ".join(lengths)
            widest = report.quantity("lengths", 10 * max(self.curve.lengths))
            yield "beam", f"{widest} or wider if the longest waves of the roughness are as long as the map"

    def _notes(self) -> Iterator[Note]:
        """Yield the notes on the curve as a whole."""
        from roughcontact.halfspace.operators.geometry import Geometry
        from roughcontact.labels.note import Note, Rank

        curve = self.curve
        law, why_none = self._fitted
        if law is None:
            yield Note(Rank.LIMITED, f"no power law: {why_none}")
        elif not law.straight and not curve.notes:  # which state a doubt about the fit already
            yield Note(Rank.DOUBTFUL, report.bend_words(law))
        for name, why in self.left_out.items():
            yield Note(Rank.LIMITED, f"theory {name} is left out: {why}")
        if self.per_area and not all(curve.periodic) and curve.geometry is Geometry.SURFACE:
            yield Note(
                Rank.USUAL,
                "K/A0 is that of the interface only; k of a free patch contains the compliance of the body "
                "under it: it is in N/m only, never per area (docs/concepts/joints.md)",
            )

    def _figure(self) -> Figure:
        """Return the picture: against pressure if per area, otherwise against force."""
        from roughcontact.plot.canvas import areal_figure, curve_figure

        laws, errors = self.drawn, {each.force: each.budget for each in self.errors}
        if self.per_area:
            return areal_figure(self.curve, self.fit, laws, self.units, errors)
        return curve_figure(self.curve, self.fit, laws, errors)


def _in_unit(column: xarray.DataArray, unit: Scale) -> xarray.DataArray:
    """Return a column in another unit, and its name with it."""
    return (column * unit.factor).assign_attrs(column.attrs | {"units": unit.unit})


def _fit_record(law: PowerLaw) -> dict[str, Any]:
    numbers: dict[str, float | None] = {
        name: float(getattr(law, name)) for name in ("exponent", "prefactor", "scatter", "bend")
    }
    error = float(law.bend_error)
    numbers["bend_error"] = error if math.isfinite(error) else None
    return numbers | {
        "straight": law.straight,
        "window": [float(end) for end in law.window],
        "count": int(law.count),
        "rule": law.rule,
    }
