"""What is refused of many maps of one surface is read or combined when its message is followed."""

import numpy as np
import pytest

import roughcontact as rc
from followed import commands, follow, follow_command, holed, row

GRID = rc.Grid((64, 64), 1e-6)
A, B = (rc.self_affine(GRID, 0.8, 1e-7, seed) for seed in (1, 2))
C = rc.self_affine(rc.Grid((48, 64), 1e-6), 0.8, 1e-7, 3)
WHITE = rc.Surface(np.random.default_rng(1).random((64, 64)), 1e-6)
PHASES = 2 * np.pi * np.random.default_rng(1).random((96, 1))
CHATTER = rc.Surface(
    1e-7 * np.sin(np.pi * np.arange(128) / 8 + PHASES) + 1e-10 * np.random.default_rng(2).random((96, 128)),
    rc.Grid((96, 128), 1e-6, periodic=True),
)

ROUGH_ROWS = np.where(np.arange(64) % 3, 1, 100)[:, None]


def many(maps=None, **options):
    return rc.Measurements.of({"a": A, "b": B} if maps is None else maps, **options)


ROWS = [
    row(lambda: many({}), "maps must hold one map at least: give a mapping of names to surfaces", many),
    row(
        lambda: many(instruments={"c": rc.Instrument()}),
        "'c' is no map, or is named twice: name each map once, of 'a', 'b'",
        lambda: many(instruments={"a": rc.Instrument()}),
    ),
    row(
        lambda: many(repeats=[("a", "b"), ("a", "b")]),
        "'a' is no map, or is named twice",
        lambda: many(repeats=[("a", "b")]),
    ),
    row(
        lambda: many({"a": A, "c": C}, repeats=[("a", "c")]),
        "the repeats of 'a' lie on different grids: crop them to one, or bring them onto one by rc.resampled()",
        lambda: many({"a": A.cropped(slice(0, 48), slice(0, 64)), "c": C}, repeats=[("a", "c")]),
    ),
    row(
        lambda: many({"a": holed()}),
        "'a' lacks 2 heights: fill them by filled(), or crop the map by cropped()",
        lambda: many({"a": holed().filled()}),
        lambda: many({"a": holed().cropped(slice(4, 16), slice(0, 16))}),
    ),
    row(
        lambda: many({"a": A, "b": 30 * B}),
        "'b' is not of the surface of the others: its spectrum is",
        lambda: many({"a": A}),
        lambda: many({"a": A, "b": B}),
    ),
    row(
        lambda: many({"white": WHITE}).combined_spectrum(),
        "no measurement has a reliable wave (limited by noise): measure larger maps, finer cells or with less noise",
        lambda: many().combined_spectrum(),
    ),
    row(
        lambda: many().combined_spectrum().interval(95),
        "level must lie between 0 and 1, not 95: give one such as 0.95",
        lambda: many().combined_spectrum().interval(0.95),
    ),
    row(
        lambda: many().combined_spectrum().interval(of="all"),
        "of must be 'mean' or 'place', not 'all'",
        lambda: many().combined_spectrum().interval(of="mean"),
        lambda: many().combined_spectrum().interval(of="place"),
    ),
    row(
        lambda: rc.Instrument(noise=3e-9),
        "noise must be a Noise, not 3e-09: give rc.Noise(rms=...)",
        lambda: rc.Instrument(noise=rc.Noise(rms=3e-9)),
    ),
    row(
        lambda: rc.Instrument(resolution=0.0),
        "resolution [m] must be positive",
        lambda: rc.Instrument(resolution=1e-6),
    ),
    row(
        lambda: rc.line_spectra(rc.Surface(np.zeros(16), 1e-6)),
        "must be a map of at least 8 x 8 cells, not (16,)",
        lambda: rc.line_spectra(A),
    ),
    row(
        lambda: rc.line_spectra(A, "ring"),
        "direction must be 'x' or 'y', not 'ring'",
        lambda: rc.line_spectra(A, "x"),
        lambda: rc.line_spectra(A, "y"),
    ),
    row(
        lambda: rc.line_spectra(CHATTER),
        "use the mean, rc.power_spectrum(surface, direction)",
        lambda: rc.power_spectrum(CHATTER, "x"),
    ),
    row(
        lambda: rc.line_spectra(A.with_heights(ROUGH_ROWS * A.heights, "a third of the rows is rough")),
        "profiles along x hold spikes: use the mean",
        lambda: rc.power_spectrum(A, "x"),
    ),
]


def save(**maps):
    for name, surface in maps.items():
        rc.write(surface, f"{name}.npz")
    return rc.read_measurements


READ = [
    row(
        lambda: rc.read_measurements([]),
        "there is no measurement to read: name files",
        lambda: save(a=A)(["a.npz"]),
    ),
    row(
        lambda: save(a=A)(["a.npz", "a.npz"]),
        "two measurements are named 'a.npz': rename a file",
        lambda: save(a=A, b=B)(["a.npz", "b.npz"]),
    ),
    row(
        lambda: save(a=A)("a.npz", surface="part"),
        "no container states a surface 'part': leave it out",
        lambda: save(a=A)("a.npz"),
    ),
    row(
        lambda: rc.read_measurements("bare.npy"),
        "bare.npy: it states no unit of its heights and no size; read it by rc.read(..., unit=..., size=...)",
        lambda: many({"a": rc.read("bare.npy", unit="nm", size="32 um")}),
    ),
]


@pytest.mark.parametrize("refusal", ROWS)
def test_a_refused_measurement_is_made_when_the_message_is_followed(refusal):
    follow(refusal)


@pytest.mark.parametrize("refusal", READ)
@pytest.mark.usefixtures("folder")
def test_a_refused_source_is_read_when_the_message_is_followed(refusal):
    follow(refusal)


WORDS = "surface measurements"
COMMANDS = f"""
$ {WORDS} a.npz bare.npy
! write it by 'surface prepare FILE new.npz --unit nm --size 1mm', with its own unit and size
> surface prepare bare.npy new.npz --unit nm --size '48um x 32um' && {WORDS} a.npz new.npz

$ {WORDS} a.npz holed.npz
! fill them by 'surface prepare --fill', or crop the map by 'surface prepare --crop'
> surface prepare holed.npz new.npz --fill && {WORDS} a.npz new.npz
> surface prepare holed.npz new.npz --crop 4:16,0:16 && {WORDS} a.npz new.npz

$ {WORDS} a.npz --surface part
! --surface: no container states a surface 'part'; leave it out
> {WORDS} a.npz

$ {WORDS} a.npz --tip-radius 1km
! no measurement has a reliable wave (limited by tip)
> {WORDS} a.npz --tip-radius 1um
"""


@pytest.mark.parametrize("refusal", commands(COMMANDS))
def test_a_command_that_is_refused_runs_when_the_message_is_followed(refusal, command, folder):
    rc.write(A, folder / "a.npz")
    follow_command(command, refusal)
