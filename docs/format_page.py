"""The page of file formats, from the tables by which files are read and the docstring of what writes them."""

import re
from inspect import cleandoc, getclosurevars, getmodule

from SurfaceTopography.IO import readers

from roughcontact.files.dispatch import READERS
from roughcontact.files.foreign import NOT_FOREIGN
from roughcontact.files.save import write
from roughcontact.files.text_dialects import DIALECTS


def formats() -> list[str]:
    """Return the lines of the page."""
    return [
        "# File formats",
        "",
        "What is read and what is written, by the ending of the file. How, what has to be said beside it, and what is "
        "refused: [Read and write files](../how-to/files.md).",
        "",
        "## Read",
        "",
        *_table(("ending", "format"), _own()),
        "",
        "A reader of ours checks what it reads. `rc.read_line` reads a profile from all of these except `.grd` and "
        "`.xyz`.",
        "",
        "## Texts known by their first lines",
        "",
        "Under any of the endings of texts. The first line or word says which one it is.",
        "",
        *_table(("reader", "format"), _dialects()),
        "",
        "## Read through SurfaceTopography",
        "",
        "With the extra `formats`, `pip install 'roughcontact[formats]'`. What it says is checked: the channel is a "
        "height by its name and unit, sizes and numbers of points fit the data.",
        "",
        *_table(("ending", "format"), _foreign()),
        "",
        "## Written",
        "",
        *_table(("ending", "content"), _written()),
    ]


def _own() -> list[tuple[str, str]]:
    """Return the endings of each reader of ours, and what its module says."""
    endings: dict[str, list[str]] = {}
    for ending, reader in READERS.items():
        # A reader of a single map stands within the function that chooses it, one of an archive within a partial.
        function = getattr(reader.read, "func", reader.read)
        read = getclosurevars(function).nonlocals.get("read", function)
        endings.setdefault(getmodule(read).__doc__, []).append(ending)
    return [(_code(found), _sentence(about)) for about, found in endings.items()]


def _dialects() -> list[tuple[str, str]]:
    """Return the module of each reader of texts that are known by their first lines, and what it says."""
    modules = [getmodule(read) for read in DIALECTS.values()]
    return [(f"`{each.__name__.rpartition('.')[2]}`", _sentence(each.__doc__)) for each in modules]


def _foreign() -> list[tuple[str, str]]:
    found = [
        (_code(f".{ending}" for ending in reader._file_extensions), reader._name)
        for reader in readers
        if reader._format not in NOT_FOREIGN
    ]
    return sorted(found, key=lambda row: row[1].lower())


def _written() -> list[tuple[str, str]]:
    """Return the rows of the table in the docstring of what writes, of which a row may go on below."""
    rows = re.search(r"^=+  =+$(.*?)^=+  =+$", cleandoc(write.__doc__), re.MULTILINE | re.DOTALL)[1]
    pairs = re.findall(r"^``(\S+)`` +(.*?)(?=^``|\Z)", rows, re.MULTILINE | re.DOTALL)
    return [(f"`{ending}`", _sentence(about)) for ending, about in pairs]


def _code(endings) -> str:
    return " ".join(f"`{ending}`" for ending in endings)


def _sentence(text: str) -> str:
    """Return a docstring on one line, its names as code."""
    return re.sub(r"`+([^`]+)`+", r"`\1`", " ".join(text.split())).rstrip(".")


def _table(head: tuple[str, str], rows: list[tuple[str, str]]) -> list[str]:
    return [f"| {' | '.join(row)} |" for row in (head, ("---", "---"), *rows)]
