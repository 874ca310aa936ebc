"""The cases of the suite, read from cases.toml: surfaces of fixed seeds, loads, tolerances, numbers to agree with."""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import roughcontact as rc

__all__ = ["CASES", "FILE", "Case", "HeightsError", "Problem", "chosen", "read", "sha256", "sketch"]

Array = npt.NDArray[np.float64]

FILE = Path(__file__).with_name("cases.toml")
SKETCHES = 3
ROUNDING = 1e-9  # of a sketch: what another order of sums or another library of transforms may change


class HeightsError(ValueError):
    """The heights are not those of the case."""


@dataclass(frozen=True, eq=False)
class Problem:
    """What a program is given: one body under one load."""

    heights: Array  # [m], shape (n, n), positive toward the flat
    spacing: tuple[float, float]  # [m]
    periodic: bool  # along both axes
    force: float = 0.0  # [N]
    modulus: float = 1.0  # E* [Pa]
    hardness: float = np.inf  # [Pa]: largest pressure
    work: float = 0.0  # of adhesion [J/m^2]
    range: float = 0.0  # of the attraction work/range exp(-gap/range) [m]
    mean_gap: float = np.nan  # [m], prescribed in adhesion
    rigid_depth: float = np.nan  # [m], the same state for a program that adds a spring to the mean
    gap: Array | None = None  # [m], that a fluid passes

    @property
    def lengths(self) -> tuple[float, float]:
        """Sides of the map [m]."""
        (ny, nx), (dy, dx) = self.heights.shape, self.spacing
        return ny * dy, nx * dx


@dataclass(frozen=True)
class Case:
    """One entry of cases.toml; calling it makes a problem."""

    name: str
    kind: str
    boundary: str
    surface: Mapping[str, Any]  # the generator and its parameters
    load: Mapping[str, float]
    tolerance: float  # that the certificate has to reach
    origin: str  # of the case and of its numbers, in words
    modulus: float = 1.0
    cell: float | None = None  # [m]; the side is 1 m otherwise
    sizes: tuple[int, ...] = ()
    seeds: tuple[int, ...] = (0,)
    stated: str = ""  # what the authors of the case measured
    oracle: Mapping[str, tuple[float, float]] | None = (
        None  # value and relative tolerance, of every size and seed
    )
    surfaces: tuple[Mapping[str, Any], ...] = ()  # of each size and seed: sha256, sketch, numbers

    @property
    def periodic(self) -> bool:
        """Whether the map repeats along both axes."""
        return self.boundary == "periodic"

    def listed(self, n: int, seed: int) -> Mapping[str, Any] | None:
        """Return what the file states of one size and seed."""
        return next((each for each in self.surfaces if (each["n"], each["seed"]) == (n, seed)), None)

    def heights(self, n: int, seed: int, file: Path | None = None) -> Array:
        """Return the heights of a size and seed, or of a user's file."""
        given = dict(self.surface)
        generator = given.pop("generator")
        if generator == "file":
            if file is None:
                raise HeightsError(f"{self.name} needs a file: --heights FILE")
            return np.ascontiguousarray(
                np.load(file) if file.suffix == ".npy" else np.loadtxt(file), dtype=float
            )
        return GENERATORS[generator](self, n, seed, **given)

    def checked(self, heights: Array, n: int, seed: int) -> str:
        """Return how the heights agree with the file: "to the bit", "to rounding" or "not listed"; refuse others."""
        listed = self.listed(n, seed)
        if listed is None:
            return "not listed"
        if listed["sha256"] == sha256(heights):
            return "to the bit"
        apart = np.abs(np.subtract(sketch(heights), listed["sketch"])).max()
        if not apart <= ROUNDING:
            raise HeightsError(
                f"{self.name}, n = {n}, seed {seed}: the heights are not those of cases.toml (off by {apart:.0e})"
            )
        return "to rounding"

    def __call__(self, n: int, seed: int, file: Path | None = None) -> Problem:
        """Return the problem; the heights are not compared with the file here."""
        if "rigid_depth" in self.load and self.listed(n, seed) is None:
            raise HeightsError(f"{self.name}: cases.toml states no mean gap for n = {n}, seed {seed}")
        heights = self.heights(n, seed, file)
        cell = self.load.get("side", 1.0) / len(heights) if self.cell is None else self.cell
        return self.problem(heights, cell, self.listed(n, seed) or {})

    def problem(self, heights: Array, cell: float, listed: Mapping[str, Any]) -> Problem:
        """Return the problem of heights on square cells."""
        load = self.load
        given: dict[str, Any] = {key: load[key] for key in ("work", "range") if key in load}
        if "rigid_depth" in load:
            given["rigid_depth"] = load["rigid_depth"] * float(heights.max() - heights.mean())
            given["mean_gap"] = listed.get("mean_gap", np.nan)
        if "level" in load:
            given["gap"] = np.maximum(load["level"] * float(heights.std()) - heights, 0.0)
        scale = _rms_slope(heights) * self.modulus if "pressure_over_slope" in load else 0.0
        if "hardness_over_slope" in load:
            given["hardness"] = load["hardness_over_slope"] * scale
        pressure = load.get("pressure", 0.0) + load.get("pressure_over_slope", 0.0) * scale
        force = load.get("force", pressure * heights.size * cell**2)
        return Problem(heights, (cell, cell), self.periodic, force, self.modulus, **given)


def sha256(heights: Array) -> str:
    """Return the digest of the heights as little-endian doubles in C order."""
    return hashlib.sha256(np.ascontiguousarray(heights, dtype="<f8").data).hexdigest()


def sketch(heights: Array) -> list[float]:
    """Return sums of the heights under fixed random weights, over their rms and the side in cells.

    Heights that went through a transform differ by rounding from one processor to another, and rounded heights still
    differ where a value lies between two digits. Sums differ by rounding only, and by more if any cell does.
    """
    found = []
    for k in range(SKETCHES):
        weights = (
            np.frombuffer(hashlib.shake_256(f"{k}{axis}".encode()).digest(size), np.uint8) / 127.5 - 1
            for axis, size in enumerate(heights.shape)
        )
        rows, columns = weights
        found.append(float(rows @ (heights @ columns)) / (float(heights.std()) * len(heights)))
    return found


def _self_affine(
    case: Case,
    n: int,
    seed: int,
    *,
    hurst: float,
    rms: float,
    longest: float | None = None,
    shortest: int | None = None,
) -> Array:
    """Return a self-affine square by this library; `longest` over the side, `shortest` in cells."""
    grid = rc.Grid((n, n), 1 / n, periodic=case.periodic)
    cut = None if shortest is None else shortest / n
    rng = np.random.default_rng(seed)
    return rc.self_affine(grid, hurst, rms, rng, long_cutoff=longest, short_cutoff=cut).heights


def _rolled_off(case: Case, n: int, seed: int, *, slope: float) -> Array:
    """Return white noise filtered to waves from the side, equal up to a quarter of it, down to eight cells."""
    waves = 2 * np.pi * np.fft.fftfreq(n)
    q = np.hypot(waves[:, None], waves)
    gain = np.where((q > 0) & (q < np.pi / 4), np.maximum(q, 8 * np.pi / n) ** -1.8, 0.0)
    heights = np.fft.ifft2(gain * np.fft.fft2(np.random.default_rng(seed).standard_normal((n, n)))).real
    return np.asarray(heights * slope / np.sqrt(sum((each**2).mean() for each in np.gradient(heights))))


def _rfgen(
    case: Case,
    n: int,
    seed: int,
    *,
    hurst: float,
    rms: float,
    lowest: float,
    highest: float = 0.33,
    most: float = np.inf,
) -> Array:
    """Return a square by the package rfgen: from `lowest` waves a side to `highest` a cell, or to `most` a side."""
    import rfgen

    highest = min(highest, most / n)
    rng = np.random.default_rng(seed)
    heights = rfgen.selfaffine_field(dim=2, N=n, Hurst=hurst, k_low=lowest / n, k_high=highest, rng=rng)
    heights *= rms / np.std(heights)
    return np.asarray(heights, dtype=np.float64)


def _rough_paraboloid(case: Case, n: int, seed: int, *, radius: float, **roughness: float) -> Array:
    """Return a paraboloid on the nodes of the unit square, with the roughness of rfgen."""
    x = np.linspace(0, 1, n) - 0.5
    heights = _rfgen(case, n, seed, **roughness)  # type: ignore[arg-type]
    heights -= (x[:, None] ** 2 + x**2) / (2 * radius)
    return heights


def _round(case: Case, n: int, seed: int, *, radius: float, sphere: bool) -> Array:
    """Return a sphere or a paraboloid about the middle; it has no seed."""
    x = (np.arange(n) + 0.5) / n - 0.5
    squares = x[:, None] ** 2 + x**2
    heights = np.sqrt(radius**2 - squares) if sphere else -squares / (2 * radius)
    return np.asarray(heights - heights.mean())


def _wave(case: Case, n: int, seed: int, *, amplitude: float) -> Array:
    """Return one cosine along axis 0."""
    return np.repeat(amplitude * np.cos(2 * np.pi * np.arange(n) / n)[:, None], n, axis=1)


def _needle(case: Case, n: int, seed: int, *, height: float) -> Array:
    """Return one cell that stands out of a plane."""
    heights = np.zeros((n, n))
    heights[n // 2, n // 2] = height
    return heights


GENERATORS: dict[str, Callable[..., Array]] = {
    "self_affine": _self_affine,
    "rolled_off": _rolled_off,
    "rfgen": _rfgen,
    "rough_paraboloid": _rough_paraboloid,
    "round": _round,
    "wave": _wave,
    "needle": _needle,
}


def _rms_slope(heights: Array) -> float:
    """Return the root mean square of |grad h| of a surface on the unit square."""
    n = len(heights)
    q = 2 * np.pi * np.fft.fftfreq(n, 1 / n)
    waves = np.abs(np.fft.fft2(heights)) ** 2 * (q[:, None] ** 2 + q**2)
    return float(np.sqrt(waves.sum())) / n**2


def read(file: Path = FILE) -> dict[str, Case]:
    """Return the cases of a file; an entry with several pressures is one case for each."""
    found: dict[str, Case] = {}
    for name, entry in tomllib.loads(file.read_text(encoding="utf-8")).items():
        pressures = entry["load"].pop("pressures", None)
        for pressure in pressures or [None]:
            each = name if pressure is None else f"{name}-{pressure:g}"
            load = entry["load"] if pressure is None else {**entry["load"], "pressure": pressure}
            found[each] = Case(each, **{**entry, "load": load})
    return found


CASES = read()


def chosen(prefixes: str) -> list[str]:
    """Return the cases of comma-separated names; what is no name stands for all that begin with it."""
    wanted = [part.strip() for part in prefixes.split(",") if part.strip()]
    unnamed = tuple(part for part in wanted if part not in CASES)
    names = [name for name in CASES if name in wanted or (unnamed and name.startswith(unnamed))]
    if not names:
        raise ValueError(f"no case begins with {prefixes!r}; there are {', '.join(CASES)}")
    return names
