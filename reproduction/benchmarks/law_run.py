"""Studies of the law in batches of samples, each collected when it is done; see `law.py`.

    python reproduction/benchmarks/law_run.py e8-cut e8-border --out DIR [--data FOLDER] [--batch 50]

Every study NAME runs in DIR/NAME, one case after the other, in batches: the first samples of all its combinations, then
the next ones. After each batch the whole samples are written to FOLDER/NAME.nc. By default FOLDER is
reproduction/data/law, from which `law.py` makes the pages. A stopped run resumes with the same command. On another
computer copy only FOLDER: its samples are taken over into DIR and not computed again.
"""

from __future__ import annotations

import argparse
import math
import time
import tomllib
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray
from law_ensembles import FOLDER, STUDIES, collect

from roughcontact.solver.control import Status
from roughcontact.study.run import run
from roughcontact.study.store import STUDY, Store
from roughcontact.study.study import Study
from roughcontact.study.task import Result

BATCH = 50  # samples


def take_over(study: Study, folder: Path, out: Path) -> int:
    """Add the collected samples of a study in `folder` to its store in `out`, and return how many it had not."""
    path = folder / f"{study.name}.nc"
    if not path.is_file():
        return 0
    with xarray.open_dataset(path, engine="h5netcdf") as data:
        found = data.load()
    if _same(found.attrs["study"]) != _same(study.to_toml()):
        raise SystemExit(f"{path} holds another study than {STUDIES / study.name}.toml")
    outer = [name for name in found["dimensionless_stiffness"].dims if name not in ("sample", "load")]
    shape = [found.sizes[name] for name in outer]
    samples = {int(sample): place for place, sample in enumerate(found["sample"])}
    records = _records(found)
    seconds = found.attrs["hours"] * 3600 / (len(samples) * math.prod(shape))
    added = 0
    with Store.open(out / study.name, _at_least(study, max(samples) + 1, out)) as store:
        done = store.done_keys()
        for number, task in enumerate(store.study.tasks()):
            if task.sample not in samples or task.key in done:
                continue
            places = dict(
                zip(outer, map(int, np.unravel_index(number % math.prod(shape), shape)), strict=True)
            )
            record = records.isel(places | {"sample": samples[task.sample]})
            store.add(task, Result(task.key, record, "", seconds))
            added += 1
    return added


def _same(text: str) -> dict[str, object]:
    """Return a study without its number of samples."""
    return {name: each for name, each in tomllib.loads(text).items() if name != "samples"}


def _records(found: xarray.Dataset) -> xarray.Dataset:
    """Return what was collected as records: a stiffness that is missing had missed its tolerance."""
    words = np.where(
        found["dimensionless_stiffness"].notnull(), Status.CONVERGED.value, Status.STAGNATED.value
    )
    return (
        found.reset_coords(drop=True)
        .drop_vars([*found.dims], errors="ignore")
        .assign(status=(found["dimensionless_stiffness"].dims, words))
    )


def _at_least(study: Study, samples: int, out: Path) -> Study:
    """Return a study with some of its samples, but all that its store holds."""
    file = out / study.name / STUDY
    before = Study.read(file).samples if file.is_file() else 1
    return study.with_samples(max(min(samples, study.samples), before))


def batches(names: Sequence[str], out: Path, folder: Path, batch: int) -> None:
    """Run studies batch by batch, and collect after each batch."""
    studies = [Study.read(STUDIES / f"{name}.toml") for name in names]
    for study in studies:
        print(f"{study.name}: {take_over(study, folder, out)} cases taken over from {folder}", flush=True)
    most = max(study.samples for study in studies)
    for count in range(batch, most + batch, batch):
        new: list[Result] = []
        for study in studies:
            summary = run(_at_least(study, count, out), out / study.name, on_result=new.append)
            print(f"{study.name}: {summary.done} cases done, {summary.failed} failed", flush=True)
        if new or count >= most:
            collect(out, folder)
        print(f"{count} samples, {time.process_time() / 3600:.2f} hours of this processor", flush=True)


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="+", metavar="NAME", help="file of examples/law, without its ending")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder of the stores")
    parser.add_argument(
        "--data", type=Path, default=FOLDER, metavar="FOLDER", help="folder of what is collected"
    )
    parser.add_argument("--batch", type=int, default=BATCH, metavar="SAMPLES", help="samples of a batch")
    options = parser.parse_args()
    batches(options.names, options.out, options.data, options.batch)


if __name__ == "__main__":
    main()
