"""How far a study is, for people and for programs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.cli.report import emit, print_facts
from roughcontact.cli.study_progress import duration

if TYPE_CHECKING:
    from roughcontact.study.record import Row
    from roughcontact.study.study import Study
    from roughcontact.study.task import Summary

__all__ = ["tell"]


def tell(
    study: Study,
    folder: Path,
    summary: Summary,
    *,
    as_json: bool,
    failures: Sequence[Row] | None = None,
    file: Path | None = None,
) -> None:
    """Print how far a study is, its `failures` if they were asked for, and the `file` that was written."""
    if as_json:
        record: dict[str, Any] = {"study": study.name, "folder": str(folder), "samples": study.samples}
        record |= {"done": summary.done, "failed": summary.failed, "left": summary.left}
        if summary.seconds:
            record["seconds"] = summary.seconds
        if file is not None:
            record["file"] = str(file)
        if failures is not None:
            record["failures"] = [
                {"key": row.key, "sample": row.sample, "parameters": row.parameters, "message": row.message}
                for row in failures
            ]
        emit(record)
        return
    each = len(study.combinations())
    facts = [
        ("study", f"{study.name} (case {study.case}, seed {study.seed})"),
        ("folder", str(folder)),
        ("cases", f"{summary.total} ({each} combinations, {study.samples} samples of each)"),
        ("done", str(summary.done)),
        ("failed", str(summary.failed)),
        ("left", str(summary.left)),
    ]
    facts += [("time", duration(summary.seconds))] if summary.seconds else []
    print_facts([("file", str(file)), *facts] if file else facts)
    for row in failures or ():
        told = ", ".join(f"{name} = {value}" for name, value in row.parameters.items())
        typer.echo(f"\nsample {row.sample}, {told}\n  {row.message}")
