"""The references behind an answer, printed after it and written beside its files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import typer

__all__ = ["cited"]

_FILE = "references.bib"


def cited(folder: Path | None, *found: Any, as_json: bool) -> tuple[str, ...]:
    """Print the references for an answer (with JSON on standard error); return the name of their file.

    The file is written only where the answer has a folder.
    """
    from roughcontact.citing.citations import citations
    from roughcontact.files.aside import written_aside

    references = citations(*found)
    typer.echo(f"\nTo cite:\n{references}", err=as_json)
    if folder is None:
        return ()
    with written_aside(folder / _FILE) as path:
        path.write_text(references.bibtex, encoding="utf-8")
    return (_FILE,)
