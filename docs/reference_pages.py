"""Pages of reference, written anew by every build from the docstrings and from the parser of the command line."""

import re
import shutil
import subprocess
import sys
from collections import defaultdict
from collections.abc import Collection
from enum import Enum
from inspect import cleandoc, isclass
from pathlib import Path
from pkgutil import resolve_name
from typing import Any

from format_page import formats
from recipe_page import recipes

from public_names import PublicName, public_names

HOME = "roughcontact"
TITLES = {  # in this order
    "surface": "Surfaces",
    "grid": "Grids",
    "material": "Solids",
    "materials": "Metals by name",
    "contact": "Contact",
    "evaluation": "Readers of a contact",
    "measurement": "Measurements of a surface",
    "fluid": "Flow through the gap",
    "friction": "Friction",
    "joints": "Joints",
    "gradients": "Derivatives",
    "adhesion": "Adhesion",
    "halfspace": "Operators",
    "slabs": "Slabs: one surface on several machines",
    "solver": "Solvers",
    "statistics": "Statistics",
    "theory": "Theory",
    "viscoelastic": "Viscoelastic bodies",
    "recipe": "Files of materials",
    "mdr": "Dimensionality reduction",
    "study": "Studies",
    "plot": "Pictures",
    "labels": "Labels and units",
    "files": "Files",
    "citing": "References to cite",
    "errors": "Errors",
    "memory": "Memory",
    "progress": "Progress",
}


def write_reference(folder: Path) -> None:
    """Write a page for each room, each name of the package, each module that it names, commands, and file formats."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    rooms: dict[str, dict[str, list[PublicName]]] = defaultdict(lambda: defaultdict(list))
    for name in public_names():
        module = name.path.rpartition(".")[0]
        if not module.rpartition(".")[2][0].isupper():  # methods stand with their class
            rooms[name.room][module].append(name)
    modules: dict[str, list[PublicName]] = defaultdict(list)
    for room, groups in rooms.items():
        _write(folder / f"{room}.rst", _room(room, groups))
        for module, names in groups.items():
            for name in names:
                modules[name.path if module == HOME else module].append(name)
    for page, names in modules.items():
        _write(folder / f"{page}.rst", _page(page, names))
    _write(folder / "commands.md", [_commands()])
    _write(folder / "recipes.md", recipes())
    _write(folder / "formats.md", formats())
    _write(folder / "parts.inc", _parts(rooms.keys()))


def _parts(rooms: Collection[str]) -> list[str]:
    """Return a list of all parts, with a sentence each, and the menu of them."""
    about = {
        "commands": ("Command line", "every command with its options, and lines to copy."),
        "recipes": ("Recipes", "every field of a job in a file."),
        "formats": ("File formats", "what is read and written, by the ending of the file."),
    }
    for room in sorted(rooms, key=list(TITLES).index):
        about[room] = (TITLES[room], _sentence(room))
    return [
        *(f"* [{title}](/api/{page}): {text}" for page, (title, text) in about.items()),
        "",
        *("```{toctree}", ":hidden:", *(f"/api/{page}" for page in about), "```"),
    ]


def _room(room: str, groups: dict[str, list[PublicName]]) -> list[str]:
    """Return the page of a room: what it holds, with the first line of each docstring."""
    lines = [*_title(TITLES[room]), _sentence(room), ""]
    for module, names in groups.items():
        if len(groups) > 1 and module != HOME:
            lines += [*_title(module, "-"), *_about(module)]
        lines += _list(names)
    pages = {name.path if module == HOME else module for module in groups for name in groups[module]}
    return [
        *lines,
        ".. toctree::",
        "   :hidden:",
        "",
        *(f"   {page}" for page in sorted(pages, key=str.lower)),
    ]


def _page(page: str, names: list[PublicName]) -> list[str]:
    """Return the page of a name or of a module."""
    of_module = names[0].path != page
    lines = _title(page.removeprefix(f"{HOME}."))
    if of_module:
        sys.modules.setdefault(page, resolve_name(page))  # a module that the package calls by another path
        lines += [f".. automodule:: {page}", "", *_list(names)]
    for name in names:
        module, _, base = name.path.rpartition(".")
        kind = "class" if isclass(name.value) else "function"
        lines += [f".. currentmodule:: {module}", "", f".. auto{kind}:: {base}"]
        if isclass(name.value):
            lines += [
                "   :members:",
                "   :exclude-members: model_config",
                *(["   :undoc-members:"] * issubclass(name.value, Enum)),
            ]
        lines.append("")
    return lines


def _list(names: list[PublicName]) -> list[str]:
    return [*(f"* :py:obj:`~{name.path}`: {_summary(name.value)}" for name in names), ""]


def _title(text: str, line: str = "=") -> list[str]:
    return [text, line * len(text), ""]


def _sentence(room: str) -> str:
    """Return what a room says of itself, without its name if that is the title."""
    text = _summary(resolve_name(f"{HOME}.{room}")).removeprefix(f"{TITLES[room]}: ")
    return text[0].upper() + text[1:]


def _about(module: str) -> list[str]:
    return [_summary(resolve_name(module)), ""]


def _summary(value: Any) -> str:
    return cleandoc(value.__doc__).partition("\n")[0]


def _commands() -> str:
    """Return what typer says of all commands; examples as lines to copy."""
    command = [sys.executable, "-m", "typer", f"{HOME}.cli.app", "utils", "docs", "--name", HOME]
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    text = text.replace(f"# `{HOME}`", "# Command line", 1)
    text = re.sub(r"\*\*Commands\*\*:\n\n(\* .*\n)+", "", text)  # stand below, where they are not cut short
    text = re.sub(rf"^(?={HOME} )", "$ ", text, flags=re.MULTILINE)
    return re.sub(r"(?:^\$ .*\n\n)+", _copied, text + "\n", flags=re.MULTILINE)


def _copied(match: re.Match[str]) -> str:
    return "```console\n" + match[0].replace("\n\n", "\n") + "```\n\n"


def _write(path: Path, lines: list[str]) -> None:
    path.write_text("\n".join(lines), encoding="utf-8")
