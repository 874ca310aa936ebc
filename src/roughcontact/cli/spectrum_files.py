"""The files of ``surface spectrum``: a table and a picture."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughcontact.cli.output import all_or_none, command_line

if TYPE_CHECKING:
    import xarray

    from roughcontact.surface.analysis.hurst import HurstFit
    from roughcontact.surface.analysis.power import PowerSpectrum
    from roughcontact.surface.surface import Surface

__all__ = ["write_spectrum"]

# The spectrum, the law fitted to it and, of a line scan, C2D of the isotropic surface that has such profiles.
_Found = tuple["PowerSpectrum", "HurstFit", "PowerSpectrum | None"]


def write_spectrum(found: _Found, record: Mapping[str, Any], surface: Surface, folder: Path) -> None:
    """Write ``spectrum.csv`` and ``spectrum.png``; the table repeats the numbers of the record."""
    from matplotlib.figure import Figure

    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv
    from roughcontact.plot.canvas import save
    from roughcontact.plot.spectrum_plot import spectrum_curve

    spectrum, law, isotropic = found
    figure = Figure(figsize=(6.0 if isotropic is None else 10.0, 4.6), layout="constrained")
    panels = figure.subplots(1, 1 if isotropic is None else 2, squeeze=False)[0]
    spectrum_curve(panels[0], spectrum, law)
    if isotropic is not None:
        spectrum_curve(panels[1], isotropic, label="isotropic surface\nwith this profile")
    source = provenance(surface, command=command_line())
    with all_or_none(folder) as aside:
        write_csv(_dataset(found, record), aside / "spectrum.csv", source, dimension="bin")
        save(figure, aside / "spectrum.png")


def _dataset(found: _Found, record: Mapping[str, Any]) -> xarray.Dataset:
    """Return the table: a row a bin, and the numbers that are known about the whole."""
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
        # The column of that name is the densities'.
        f"hurst_{name}" if name == "standard_error" else name: ((), record[name], {"units": units})
        for name, units in record["units"].items()
        if record[name] is not None
    }
    data = {name: ("bin", column, {"units": units}) for name, (column, units) in columns.items()}
    return xarray.Dataset({**scalars, **data, "reliable": ("bin", reliable)}, attrs={"kind": spectrum.kind})
