"""Damage files of every format in every way, and count what is refused, warned of, or read wrong without a word.

    python benchmarks/damage.py [FILES_PER_WAY [FOLDER]]

Each file below, and each measured one in FOLDER, is damaged in the ways below, FILES_PER_WAY times each (3). The
table states what comes of it by format: refused, read right, read wrong with a warning, read wrong in silence, and what
the silent ones have changed.
"""

import sys
import tempfile
import warnings
from collections import Counter, defaultdict
from pathlib import Path

import numpy as np

import roughcontact as rc

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
import instruments as of

GIVEN = {
    ".npy": {"unit": "um", "size": 18e-6},
    ".mat": {"unit": "um", "size": 18e-6},
    ".tif": {"unit": "nm", "size": 18e-6},
    "rsciio_test_surface_au.sur": {"unit": "nm"},
}
HEADER = 512


def flipped(data, rng, start, stop, count):
    spoilt = bytearray(data)
    for place in rng.integers(start, max(start + 1, min(stop, len(data))), count):
        spoilt[place] ^= 1 << int(rng.integers(8))
    return bytes(spoilt)


def edited(data, rng, taken, put):
    place = int(rng.integers(len(data)))
    return data[:place] + put + data[place + taken :]


def noise(rng, data):
    place = int(rng.integers(len(data)))
    length = int(rng.integers(16, max(17, len(data) // 4)))
    return data[:place] + rng.bytes(len(data[place : place + length])) + data[place + length :]


WAYS = {
    "a bit of the header": lambda d, r: flipped(d, r, 0, HEADER, 1),
    "20 bits of the header": lambda d, r: flipped(d, r, 0, 2000, 20),
    "a bit anywhere": lambda d, r: flipped(d, r, 0, len(d), 1),
    "50 bits anywhere": lambda d, r: flipped(d, r, 0, len(d), 50),
    "a byte more": lambda d, r: edited(d, r, 0, r.bytes(1)),
    "a byte less": lambda d, r: edited(d, r, 1, b""),
    "a byte more in the header": lambda d, r: edited(d[:HEADER], r, 0, r.bytes(1)) + d[HEADER:],
    "100 bytes less": lambda d, r: edited(d, r, 100, b""),
    "a quarter of zeros": lambda d, r: edited(d, r, len(d) // 4, bytes(len(d) // 4))[: len(d)],
    "noise": lambda d, r: noise(r, d),
    "cut": lambda d, r: d[: int(len(d) * r.uniform(0.02, 1))],
    "two blocks exchanged": lambda d, r: d[: len(d) // 2] + d[-len(d) // 4 :] + d[len(d) // 2 : -len(d) // 4],
}


def written():
    """Give small files of the formats that few lines write."""
    z = of.hills()
    um, counts = z * 1e-6, np.rint(z * 9000)
    field = of.gwy_field(um)
    yield "gsf.gsf", of.gsf(um)
    yield "gwy.gwy", of.gwy(field, of.gwy_field(z, ("m", "V")), titles=("Height", "Phase"))
    yield "sdf-binary.sdf", of.sdf_binary(counts, 5)
    yield "sdf-double.sdf", of.sdf_binary(z * 1e3, 7, mark="bBCR-1.0")
    yield "sdf-text.sdf", of.sdf_text(counts, 6, mark="aBCR-1.0")
    yield "tmd.tmd", of.tmd(z * 1e-3)
    yield "tiff-16.tif", of.tiff((counts + 20000).astype("u2"), rows=8)
    yield "tiff-float.tif", of.tiff((z * 100).astype("f4"), order=">")
    yield "tiff-deflate.tif", of.tiff((counts + 20000).astype("u2"), rows=8, deflate=True)
    yield (
        "nanoscope.001",
        of.nanoscope(np.rint(of.hills(16, 72) * 9000), size="2 2 ~m", aspect="4.5:1", scan_aspect="4.5:1"),
    )
    yield "matlab.mat", of.mat(Z=z)


def ours(folder):
    """Give the files that roughcontact writes."""
    surface = rc.Surface(of.hills() * 1e-6, rc.Grid((32, 36), 5e-7))
    for kind in (".npy", ".npz", ".nc", ".x3p", ".txt"):
        rc.write(surface, folder / f"ours{kind}")
        yield f"ours{kind}", (folder / f"ours{kind}").read_bytes()


def attempt(path):
    """Return the surface, or None where it is refused, and whether a warning was given."""
    given = GIVEN.get(path.name, GIVEN.get(path.suffix, {}))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            found = rc.read(path, **given)
        except rc.ReadError:
            return None, set()
    return found, {str(one.message) for one in said if one.category is rc.SurfaceWarning}


def change(found, truth):
    """Return what of a surface is another, or None."""
    if found.grid.shape != truth.grid.shape:
        return "another number of points"
    same = np.isclose(found.heights, truth.heights, rtol=1e-6, atol=1e-9 * truth.rms, equal_nan=True)
    cells = np.allclose(found.grid.spacing, truth.grid.spacing, rtol=1e-6, atol=0)
    if same.all():
        return None if cells else "the size"
    both = np.isfinite(found.heights) & np.isfinite(truth.heights)
    a, b = truth.heights[both], found.heights[both]
    if a.size > 2 and np.ptp(a) > 0:
        slope = float(a @ b / (a @ a))
        if np.allclose(b, slope * a, rtol=1e-9, atol=1e-9 * np.ptp(b)):
            return "the scale of heights" if abs(slope - 1) > 1e-9 else "which points are missing"
    count = int(np.count_nonzero(~same))
    off = np.nanmax(np.abs(found.heights - truth.heights), initial=0.0) / np.ptp(a)
    if count <= 60:
        return f"at most 60 heights, by {'less than 5 %' if off < 0.05 else 'more than 5 %'} of their range"
    return "many heights"


def main(per_way, folder):
    table, silent = defaultdict(Counter), defaultdict(Counter)
    with tempfile.TemporaryDirectory() as place:
        files = [*written(), *ours(Path(place))]
        files += [(p.name, p.read_bytes()) for p in sorted(Path(folder).glob("*"))] if folder else []
        for name, data in files:
            path = Path(place) / name
            path.write_bytes(data)
            truth, usual = attempt(path)
            if truth is None:
                continue
            for number, (way, damage) in enumerate(WAYS.items()):
                for trial in range(per_way):
                    rng = np.random.default_rng([number, trial, len(data)])
                    path.write_bytes(damage(data, rng))
                    found, said = attempt(path)
                    what = None if found is None else change(found, truth)
                    if found is None or what is None:
                        table[name]["refused" if found is None else "right"] += 1
                    elif said - usual:
                        table[name]["warned"] += 1
                    else:
                        table[name]["silent"] += 1
                        silent[name][f"{what} ({way})"] += 1
            counts = table[name]
            shown = " ".join(f"{counts[kind]:5}" for kind in ("refused", "right", "warned", "silent"))
            print(
                f"{name:28} {shown}  {'; '.join(f'{n} {what}' for what, n in silent[name].most_common())}",
                flush=True,
            )
    total = sum(table.values(), Counter())
    print(f"{sum(total.values())} files: {dict(total)}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 3, sys.argv[2] if len(sys.argv) > 2 else None)
