"""What each dependency weighs on disk, and what it is for: the table of docs/project/release.md.

python benchmarks/weights.py    in an environment that holds the package and what it needs
"""

from __future__ import annotations

from importlib.metadata import distribution
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

PURPOSES = {
    "numpy": "arrays",
    "scipy": "Fourier transforms, linear algebra, special functions",
    "llvmlite": "machine code for the sums on this processor; without it, NumPy and SciPy compute them",
    "array-api-compat": "heights in arrays of PyTorch or CuPy, on a GPU",
    "threadpoolctl": "linear algebra in one thread where more threads would be slower",
    "psutil": "free memory, checked before a computation",
    "typer": "the command line",
    "rich": "tables and progress bars of the command line",
    "pint": "units in files and on the command line",
    "matplotlib": "pictures: `--out` of every command, `plot`",
    "xarray": "answers with units and names: `curve.nc`, `to_dataset`, `to_dataframe`; averages of studies",
    "h5netcdf": "reading and writing NetCDF files",
    "h5py": "HDF5, on which NetCDF-4 files are based",
    "pydantic": "checks of study files, with messages",
    "filelock": "one writer for the store of a study",
    "platformdirs": "the user's cache folder, in which machine code is stored",
    "tomli-w": "writing study files and recipes",
}


def needed(name: str, extra: str = "") -> set[str]:
    """Return the names of what a distribution needs in this environment, with those of an extra or of none."""
    texts = distribution(name).requires or []
    found = (Requirement(text) for text in texts)
    return {
        canonicalize_name(each.name)
        for each in found
        if not each.marker or each.marker.evaluate({"extra": extra})
    }


def closure(names: set[str]) -> set[str]:
    """Return the names with those of all that they need."""
    found: set[str] = set()
    while left := names - found:
        found |= left
        names = names.union(*(needed(name) for name in left))
    return found


def size(name: str) -> float:
    """Return what the files of a distribution take on disk [MB], compiled modules included."""
    paths = (Path(str(each.locate())) for each in distribution(name).files or ())
    return sum(path.stat().st_size for path in paths if path.is_file()) / 1e6


def table() -> list[str]:
    """Return the table, the heaviest first."""
    direct = needed("roughcontact")
    rows = []
    for name in direct:
        brought = closure({name}) - closure(direct - {name}) - {name}
        rows.append(
            (size(name), sum(map(size, brought)), name, ", ".join(sorted(brought, key=size)[::-1][:3]))
        )
    lines = ["| dependency | MB | brings | MB | for |", "|---|---|---|---|---|"]
    for own, more, name, brought in sorted(rows, reverse=True):
        lines.append(
            f"| {name} | {own:.1f} | {brought} | {f'{more:.1f}' if brought else ''} | {PURPOSES[name]} |"
        )
    everything = closure(direct)
    lines.append(f"| all {len(everything)} | {sum(map(size, everything)):.0f} | | | |")
    return lines


def page() -> str:
    """Return what the extra of the page adds to that."""
    direct = needed("roughcontact", "page") - needed("roughcontact")
    added = closure(direct) - closure(needed("roughcontact"))
    brought = sorted(added - direct, key=size)[::-1]
    return f"The extra `page`: {sum(map(size, added)):.1f} MB ({', '.join([*sorted(direct), *brought])})."


if __name__ == "__main__":
    print("\n".join(table()))
    print(page())
