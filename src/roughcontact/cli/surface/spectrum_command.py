"""The command ``surface spectrum``: Hurst exponent, limits and moments of a measured surface."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from roughcontact.cli.contact_of_job import name_of, prepared
from roughcontact.cli.messages import UsageError, note, remark
from roughcontact.cli.options import Answer
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.report import emit, print_facts, quantity, size_of
from roughcontact.cli.run_memory import require_memory
from roughcontact.errors import InputError
from roughcontact.files.quantity import LENGTH
from roughcontact.labels.engineering_units import written
from roughcontact.progress.events import task
from roughcontact.recipe.elastic_jobs import SurfaceJob
from roughcontact.recipe.recipe_fields import check, described, value_of
from roughcontact.recipe.source import File
from roughcontact.recipe.texts import Amount, Choice

if TYPE_CHECKING:
    import xarray

    from roughcontact.surface.analysis.hurst import HurstFit
    from roughcontact.surface.analysis.power import PowerSpectrum
    from roughcontact.surface.surface import Surface

__all__ = ["EXAMPLES", "spectrum"]

EXAMPLES = {
    "spectrum": """
roughcontact surface spectrum part.x3p --out result
roughcontact surface spectrum h.csv --unit nm --size 1mm --shortest 10um --json
roughcontact surface spectrum scan.csv --out result
""",
}
_FINE = 200.0  # bins per decade for the fit, which must be narrow compared with changes of the law
_COARSE = 20.0  # of the table and the moments
_FILTERED = re.compile(r"Gaussian filter: waves (below|above) (\S+) m removed")
_CLEAR = (
    3.0  # times its cut-off: there a short-wave filter takes a seventh of the power, a long-wave one 0.4 %
)
_BYTES_PER_POINT = 64  # heights, their levelled copy, the transform and its squares
_LIMITS = {"rolloff": "roll-off", "long_cutoff": "long cut-off", "short_cutoff": "short cut-off"}
_UNITS = {
    **dict.fromkeys(("rms", "rms_in_band", "longest", "shortest", *_LIMITS), "m"),
    **{"m0": "m2", "m4": "m-2", "rms_curvature": "m-1"},
    **dict.fromkeys(
        ("hurst", "standard_error", "misfit", "m2", "rms_slope", "isotropic_rms_slope", "nayak"), "1"
    ),
}


# The spectrum, the fitted law, and for a profile C2D of the isotropic surface with such profiles.
_Found = tuple["PowerSpectrum", "HurstFit", "PowerSpectrum | None"]


_WAVE = Amount(LENGTH, "a wavelength")


@dataclass(frozen=True, slots=True, kw_only=True)
class Asked:
    """The spectrum and the law that are asked for."""

    TITLE: ClassVar = "Spectrum"
    direction: str = described(
        "Average over all directions (ring: C2D), or spectrum of the profiles along one (x, y: C1D); "
        "auto: ring of a map, x of a profile.",
        read=Choice(("auto", "ring", "x", "y")),
        default="auto",
        everyday=True,
    )
    limit: str = described(
        "How the power law ends at long waves.",
        read=Choice(("auto", "none", "rolloff", "long_cutoff")),
        default="auto",
        everyday=True,
    )
    longest: str | None = described(
        "Longest wave that counts (default: a third of a free map's length).",
        "100um",
        read=_WAVE,
        everyday=True,
    )
    shortest: str | None = described(
        "Shortest wave that the instrument follows (default: two cells).", "1um", read=_WAVE, everyday=True
    )
    level: str | None = described(
        "Trend to remove from the heights (default: a least-squares plane).",
        read=Choice(("plane", "mean", "none")),
        everyday=True,
    )
    fill: bool = described("Fill missing points smoothly first.", default=False, everyday=True)

    def __post_init__(self) -> None:
        check(self)
        if self.longest and self.shortest and not value_of(self, "longest") > value_of(self, "shortest"):
            raise InputError(
                f"the longest wave, {self.longest}, must be longer than the shortest, {self.shortest}",
                "exchange the two",
                "longest",
            )

    def band(self) -> dict[str, float]:
        """Return the band that was asked for as wavenumbers [rad/m]."""
        ends = {"q_min": value_of(self, "longest"), "q_max": value_of(self, "shortest")}
        return {name: 2 * math.pi / length for name, length in ends.items() if length is not None}


def spectrum(source: File, *, asked: Asked, answer: Answer) -> None:
    """Power spectrum of a surface or profile: Hurst exponent with its error, roll-off or cut-off, rms, moments.

    For a profile it is C1D, together with C2D of the isotropic surface that has such profiles.
    """
    with output(answer.out) as folder:
        surface = _surface(source, asked.fill)
        with task("Spectrum, law and files"):
            found, law = _analysed(surface, asked)
            record = _record(surface, found, law, name_of(source))
            if folder is not None:
                isotropic = _isotropic(surface, found, law)
                _write((found.rebinned(_COARSE), law, isotropic), record, surface, folder, answer.ending)
    if answer.json:
        emit(record)
    else:
        print_facts(_facts(surface, record))
    for line in record["notes"]:
        note(line)
    answer.finish(folder, ("spectrum.csv", "spectrum.nc", f"spectrum.{answer.ending}"), surface, found)


def _surface(source: File, fill: bool) -> Surface:
    """Return the surface without missing points; its tilt is removed when the spectrum is taken."""
    surface: Surface = prepared(SurfaceJob(source=source), _require_memory)["surface"]
    if surface.missing and not fill:
        raise UsageError(
            f"{source.file}: {surface.missing} points are missing, and a spectrum needs all points",
            "add --fill, or crop them away by 'roughcontact surface prepare'",
        )
    if surface.missing:
        note(f"{surface.missing} missing points are filled smoothly: the shortest waves are too weak there")
        surface = surface.filled()
    return surface


def _require_memory(surface: Surface) -> None:
    require_memory(_BYTES_PER_POINT * surface.grid.size, surface.grid.shape)


def _analysed(surface: Surface, asked: Asked) -> tuple[PowerSpectrum, HurstFit]:
    """Return the spectrum in fine bins, its band set, and the law that fits it."""
    import roughcontact as rc

    direction: Any = asked.direction  # checked: one of the words of the library
    limit: Any = asked.limit
    level: Any = asked.level or "auto"
    band = asked.band()
    if asked.level is None and not all(surface.grid.periodic):
        trend = "plane" if surface.grid.ndim == 2 else "line"
        remark(
            f"the tilt is removed by a least-squares {trend} (choose otherwise by --level mean or --level none)"
        )
    whole = rc.power_spectrum(surface, direction, level=level, per_decade=_FINE)
    whole = replace(whole, q_min=band.get("q_min", whole.q_min), q_max=band.get("q_max", whole.q_max))
    return whole, rc.fit_spectrum(whole, limit=limit)


def _record(surface: Surface, spectrum: PowerSpectrum, law: HurstFit, file: str) -> dict[str, Any]:
    import roughcontact as rc

    moments = rc.spectrum_moments(spectrum.rebinned(_COARSE), q_min=spectrum.q_min, q_max=spectrum.q_max)
    values = {
        **{name: getattr(law, name) for name in ("hurst", "standard_error", "misfit")},
        "longest": 2 * math.pi / spectrum.q_min,
        "shortest": 2 * math.pi / spectrum.q_max,
        **{name: getattr(law, name) for name in _LIMITS},
        "rms": surface.rms if all(surface.grid.periodic) else surface.levelled("plane").rms,
        "rms_in_band": moments.rms_height,
        **{
            name: getattr(moments, name) for name in ("rms_slope", "rms_curvature", "m0", "m2", "m4", "nayak")
        },
    }
    if surface.grid.ndim == 1:
        values["isotropic_rms_slope"] = replace(moments, dimension=2).rms_slope
    return {
        "command": "surface spectrum",
        "file": file,
        "kind": spectrum.kind,
        # JSON cannot express infinite or unknown values.
        **{name: v if v is None or math.isfinite(v) else None for name, v in values.items()},
        "notes": _warnings(surface, law),
        "provenance": list(surface.provenance),
        "units": {name: unit for name, unit in _UNITS.items() if name in values},
    }


def _warnings(surface: Surface, law: HurstFit) -> list[str]:
    """Return a note if the misfit exceeds chance, with the filters that overlap the fitted band."""
    if law.misfit <= law.chance:
        return []
    longest, shortest = (2 * math.pi / wavenumber for wavenumber in law.band)
    reasons = []
    for gone, text in _FILTERED.findall("\n".join(surface.provenance)):
        cutoff, short = float(text), gone == "below"
        clear = cutoff * _CLEAR if short else cutoff / _CLEAR
        if shortest < clear if short else longest > clear:
            what = f"the cut-off of a filter that removed waves {gone} {quantity('lengths', cutoff)}"
            end = "shortest" if short else "longest"
            reasons.append(f"the band runs past {what}; give --{end} {clear:.3g}")
    why = " and ".join(reasons) or "the spectrum is no power law; narrow the band by --longest and --shortest"
    return [f"the fit is poor, misfit {law.misfit:.3g} where chance stays below {law.chance:.2g}: {why}"]


def _facts(surface: Surface, record: Mapping[str, Any]) -> list[tuple[str, str]]:
    ends = [
        (label, quantity("lengths", record[name]))
        for name, label in _LIMITS.items()
        if record[name] is not None
    ]
    band = f"{quantity('lengths', record['longest'])} to {quantity('lengths', record['shortest'])}"
    nayak = "unknown" if record["nayak"] is None else f"{record['nayak']:.4g}"
    facts = [
        ("file", record["file"]),
        ("surface" if surface.grid.ndim == 2 else "profile", size_of(surface.grid)),
        ("Hurst exponent H", f"{record['hurst']:.4f} ± {record['standard_error']:.4f}"),
        ("misfit", f"{record['misfit']:.3g} (near 1 where the law holds)"),
        ("waves", band),
        *(
            ends
            or [
                (
                    "limits",
                    "none found" if record["notes"] else "none found: the law holds over the whole band",
                )
            ]
        ),
        (
            "rms height",
            f"{quantity('rms', record['rms'])}; {quantity('rms', record['rms_in_band'])} in the band",
        ),
        ("rms slope in the band", f"{record['rms_slope']:.4g}"),
        ("rms curvature in the band", written(record["rms_curvature"] * 1e-3, "", 4) + " 1/mm"),
        (
            "moments of the band",
            f"m0 = {record['m0']:.4g} m², m2 = {record['m2']:.4g}, m4 = {record['m4']:.4g} 1/m²",
        ),
        ("Nayak's parameter", nayak),
    ]
    if surface.grid.ndim == 1:
        facts.append(("isotropic surface", f"rms slope {record['isotropic_rms_slope']:.4g} in the band"))
    return facts


def _isotropic(surface: Surface, spectrum: PowerSpectrum, law: HurstFit) -> PowerSpectrum | None:
    """Return C2D of the isotropic surface that has such profiles, if one exists."""
    import roughcontact as rc

    if surface.grid.ndim == 2:
        return None
    try:
        return rc.surface_spectrum(spectrum.rebinned(_COARSE), hurst=law.hurst)
    except ValueError as error:
        note(f"no C2D: {error}")
        return None


def _write(found: _Found, record: Mapping[str, Any], surface: Surface, folder: Path, ending: str) -> None:
    """Write the table as ``spectrum.csv`` and ``spectrum.nc``, and the picture."""
    from matplotlib.figure import Figure

    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_netcdf
    from roughcontact.plot.canvas import save
    from roughcontact.plot.spectrum_plot import spectrum_curve

    spectrum, law, isotropic = found
    figure = Figure(figsize=(6.0 if isotropic is None else 10.0, 4.6), layout="constrained")
    panels = figure.subplots(1, 1 if isotropic is None else 2, squeeze=False)[0]
    spectrum_curve(spectrum, panels[0], law=law)
    if isotropic is not None:
        spectrum_curve(isotropic, panels[1], label="isotropic surface\nwith this profile")
    source, table = provenance(surface, command=command_line()), _table(found, record)
    with all_or_none(folder) as aside:
        write_csv(table, aside / "spectrum.csv", dimension="bin")
        write_netcdf(table, aside / "spectrum.nc", source)
        save(figure, aside / f"spectrum.{ending}")


def _table(found: _Found, record: Mapping[str, Any]) -> xarray.Dataset:
    """Return the table: one row per bin, and the numbers of the whole spectrum."""
    import xarray

    spectrum, law, isotropic = found
    q = spectrum.wavenumber
    unit = {"C2D": "m4", "C1D": "m3"}[spectrum.kind]
    columns = {
        "wavenumber": (q, "rad m-1"),
        "wavelength": (spectrum.wavelength, "m"),
        "density": (spectrum.density, unit),
        "standard_error": (spectrum.standard_error, unit),
        "law": (law(q), unit),
    }
    if isotropic is not None:
        columns["isotropic_density"] = (isotropic.density, "m4")
    reliable = (q >= spectrum.q_min * (1 - 1e-9)) & (q <= spectrum.q_max * (1 + 1e-9))
    scalars = {
        # The column of that name holds the densities.
        f"hurst_{name}" if name == "standard_error" else name: ((), record[name], {"units": units})
        for name, units in record["units"].items()
        if record[name] is not None
    }
    data = {name: ("bin", column, {"units": units}) for name, (column, units) in columns.items()}
    return xarray.Dataset({**scalars, **data, "reliable": ("bin", reliable)}, attrs={"kind": spectrum.kind})
