"""The command ``surface measurements``: many maps and profiles of one surface, and their combined spectrum."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from roughcontact.cli.messages import note, plain
from roughcontact.cli.option_groups import argument, option
from roughcontact.cli.options import Answer
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.report import emit, print_facts, print_table, quantity
from roughcontact.files.quantity import LENGTH
from roughcontact.labels.engineering_units import written
from roughcontact.progress.events import task
from roughcontact.recipe.recipe_fields import check, described, values_of
from roughcontact.recipe.texts import Amount

if TYPE_CHECKING:
    from roughcontact.measurement.combined_spectrum import CombinedSpectrum
    from roughcontact.measurement.measurement import Measurement
    from roughcontact.measurement.measurements import Measurements

__all__ = ["EXAMPLES", "measurements"]

EXAMPLES = {
    "measurements": """
roughcontact surface measurements place1.npz place2.npz place3.npz --resolution 2um --out result
roughcontact surface measurements scans --tip-radius 2um --noise 1nm --json
roughcontact surface measurements container.zip
""",
}
FILES = argument("Maps and profiles, folders of them, or containers of contact.engineering.", "SOURCE")
SURFACE = option("The surface to read from containers of several surfaces.", "NAME")
_COLUMNS = ("wavenumber", "density", "mean_low", "mean_high")
_UNITS = dict.fromkeys(("lengths", "spacing", "rms", "band", "noise"), "m")


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuringInstrument:
    """What limits the waves of all measurements, in place of what their containers state."""

    TITLE: ClassVar = "Instrument"
    resolution: str | None = described(
        "Lateral period limit of the instrument: the wavelength whose amplitude it halves.",
        "2um",
        read=Amount(LENGTH, "the resolution"),
        everyday=True,
    )
    tip_radius: str | None = described(
        "Radius of a tip that follows the surface.",
        "2um",
        read=Amount(LENGTH, "the tip radius"),
        everyday=True,
    )
    noise: str | None = described(
        "Standard deviation of the random error of a height (default: by the flat end of the spectrum).",
        "1nm",
        read=Amount(LENGTH, "the noise"),
        everyday=True,
    )

    def __post_init__(self) -> None:
        check(self)

    def applied(self, found: Measurements) -> Measurements:
        """Return measurements by this instrument, where it is given."""
        import roughcontact as rc

        stated = values_of(self)
        if not stated:
            return found
        if "noise" in stated:
            stated["noise"] = rc.Noise(stated["noise"])
        return rc.Measurements.of(
            {one.name: one.surface for one in found},
            instruments={one.name: replace(one.instrument, **stated) for one in found},
            surface=found.surface,
            left_out=found.left_out,
        )


def measurements(
    source: list[Path] = FILES,
    *,
    surface: str | None = SURFACE,
    instrument: MeasuringInstrument,
    answer: Answer,
) -> None:
    """Reliable band and weight of each map of a surface, and one spectrum of all maps in their bands.

    Maps that differ from the others are named, and do not count in the spectrum.
    """
    import roughcontact as rc

    with output(answer.out) as folder:
        with task("Reading"):
            found = instrument.applied(rc.read_measurements(source, surface=surface))
        with task("Spectrum and files"):
            spectrum = found.combined_spectrum()
            if folder is not None:
                _write(spectrum, folder, answer.ending)
    if answer.json:
        emit(_record(found, spectrum))
    else:
        print_table(
            ("name", "cells", "size", "pixel", "rms", "reliable waves", "limited by", "weight", "noise", ""),
            [_row(one, one.name in spectrum.outlying) for one in found],
        )
        waves = " to ".join(written(float(each), "m", 3) for each in spectrum.wavelength[[-1, 0]])
        print_facts([("spectrum", f"{spectrum.kind} in {spectrum.wavenumber.size} bins, waves of {waves}")])
    for text in spectrum.notes:
        note(text)
    names = [f"measurements.{ending}" for ending in ("csv", "nc", answer.ending)]
    answer.finish(folder, names, found, spectrum)


def _row(one: Measurement, differs: bool) -> list[str]:
    grid = one.surface.grid
    size, pixel = (
        " x ".join(quantity("lengths", side) for side in of) for of in (grid.lengths, grid.spacing)
    )
    band = " to ".join(written(each, "m", 3) for each in one.band) if one.reliable else "none"
    noise = "not found" if one.noise is None else f"{written(one.noise.rms, 'm', 3)} ({one.noise_found})"
    cells = " x ".join(map(str, grid.shape))
    return [
        *(plain(one.name), cells, size, pixel, quantity("rms", _rms(one)), band, one.limited_by),
        *(f"{one.weight:.0f}", noise, "differs, not in the spectrum" if differs else ""),
    ]


def _rms(one: Measurement) -> float:
    """Return the rms height without tilt [m]."""
    return one.surface.levelled("mean" if all(one.surface.grid.periodic) else "plane").rms


def _record(found: Measurements, spectrum: CombinedSpectrum) -> dict[str, Any]:
    rows = [
        {
            "name": plain(one.name),
            **{name: getattr(one.surface.grid, name) for name in ("shape", "lengths", "spacing")},
            **{name: getattr(one, name) for name in ("band", "limited_by", "weight", "noise_found")},
            "rms": _rms(one),
            "noise": one.noise and one.noise.rms,
            "outlying": one.name in spectrum.outlying,
        }
        for one in found
    ]
    columns = {name: spectrum.to_dataset()[name] for name in _COLUMNS}
    return {
        "command": "surface measurements",
        "surface": found.surface,
        "measurements": rows,
        "kind": spectrum.kind,
        **{name: values.to_numpy().tolist() for name, values in columns.items()},
        "notes": list(spectrum.notes),
        "units": _UNITS | {name: values.attrs["units"] for name, values in columns.items()},
    }


def _write(spectrum: CombinedSpectrum, folder: Path, ending: str) -> None:
    from matplotlib.figure import Figure

    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_netcdf
    from roughcontact.plot.canvas import save
    from roughcontact.plot.measured_plot import combined_spectrum

    figure = Figure(figsize=(6.0, 4.6), layout="constrained")
    combined_spectrum(spectrum, figure.subplots())
    table = spectrum.to_dataset()
    with all_or_none(folder) as aside:
        rows = table.drop_indexes("wavenumber").rename_dims(wavenumber="bin").reset_coords("wavenumber")
        write_csv(rows, aside / "measurements.csv", dimension="bin")
        write_netcdf(table, aside / "measurements.nc", provenance(command=command_line()))
        save(figure, aside / f"measurements.{ending}")
