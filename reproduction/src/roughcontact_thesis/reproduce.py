"""From a figure of an ensemble to its averages: run its studies where they are kept, and average what they export."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import xarray

from roughcontact.errors import InputError
from roughcontact.study.export import export
from roughcontact.study.run import run
from roughcontact.study.store import Store
from roughcontact.study.study import Study
from roughcontact.study.task import Executor, Summary
from roughcontact_thesis.figures import EnsembleFigure, Scale, Studies

__all__ = ["STUDIES", "averages_of", "planned", "run_study", "store_of"]

STUDIES = "studies"
"""Folder beside the pictures that holds a store a study."""


def planned(found: EnsembleFigure, scale: Scale = "small", seed: int | None = None) -> Studies:
    """Return the studies of a figure; another `seed` than their own gives them another name, and so another store.

    Parameters
    ----------
    found : EnsembleFigure
        Of `module`.
    scale : {"small", "thesis"}
        Two minutes on two cores at most, or the counts of the thesis.
    seed : int, optional
        By default that of each study.

    Returns
    -------
    tuple of Study

    Examples
    --------
    >>> import roughcontact_thesis
    >>> found = roughcontact_thesis.module("fig27")
    >>> [(study.name, study.samples) for study in roughcontact_thesis.planned(found, "thesis")]
    [('squares', 50), ('lines', 20)]
    """
    studies = found.studies(scale)
    if seed is None:
        return studies
    return tuple(
        each.model_copy(update={"seed": seed, "name": f"{each.name}-seed-{seed}"}) for each in studies
    )


def store_of(folder: str | os.PathLike[str], study: Study) -> Path:
    """Return where a study is kept under a folder."""
    return Path(folder) / STUDIES / study.name


def run_study(study: Study, folder: str | os.PathLike[str], executor: Executor) -> Summary:
    """Run a study in its store under `folder`; what is done already is not done again.

    Parameters
    ----------
    study : Study
        One of `planned`.
    folder : path-like
        Its folder ``studies`` holds a store a study.
    executor : Executor
        Such as `roughcontact.study.Processes`.

    Returns
    -------
    Summary

    Examples
    --------
    >>> import roughcontact as rc
    >>> import roughcontact_thesis
    >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "hurst": 0.8, "loads": 3}
    >>> study = rc.study.Study(name="few", case="curve", samples=2, parameters=fixed)  # or one of planned
    >>> roughcontact_thesis.run_study(study, "figures", rc.study.Serial()).done
    2
    """
    return run(study, store_of(folder, study), executor)


def averages_of(found: EnsembleFigure, studies: Studies, folder: str | os.PathLike[str]) -> xarray.Dataset:
    """Return what a figure shows, from what the stores of its studies under `folder` hold so far.

    Attributes say what that was, an entry a study: ``studies`` as TOML, ``cases_done``, ``cases_failed`` and
    ``cases_missing``, and ``cases_seconds``, the time that its cases took together.

    Parameters
    ----------
    found : EnsembleFigure
        Of `module`.
    studies : tuple of Study
        Those that were `planned`.
    folder : path-like
        Where they were run, see `run_study`.

    Returns
    -------
    Dataset

    Raises
    ------
    ValueError
        If there is no such store.

    Examples
    --------
    >>> import roughcontact_thesis
    >>> found = roughcontact_thesis.module("fig18")
    >>> studies = roughcontact_thesis.planned(found)
    >>> [(study.case, study.samples) for study in studies]
    [('curve', 10), ('lines', 4)]
    >>> try:
    ...     roughcontact_thesis.averages_of(found, studies, "figures")
    ... except ValueError as error:
    ...     print(error)
    the study 'squares-small' was not run in figures: run it first
    """
    exports = tuple(_exports(studies, folder))
    return found.averages(*exports).assign_attrs(_origin(exports))


def _exports(studies: Studies, folder: str | os.PathLike[str]) -> Iterator[xarray.Dataset]:
    for study in studies:
        if not (store_of(folder, study) / "study.toml").is_file():
            raise InputError(f"the study {study.name!r} was not run in {folder}", "run it first")
        with Store.open(store_of(folder, study)) as store:
            yield export(store, seconds=True)


def _origin(exports: tuple[xarray.Dataset, ...]) -> dict[str, Any]:
    """Return what was averaged, see `averages_of`."""
    origin: dict[str, Any] = {"studies": [each.attrs["study"] for each in exports]}
    for status in ("done", "failed", "missing"):
        origin[f"cases_{status}"] = [int((each["case_status"] == status).sum()) for each in exports]
    return origin | {"cases_seconds": [float(each["case_seconds"].sum()) for each in exports]}
