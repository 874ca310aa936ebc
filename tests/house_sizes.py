"""How large the house is: `python tests/house_sizes.py` prints what tests/test_budgets.py keeps in bounds.

Lines of code are lines of the syntax tree's statements and of what they hold: no blank line, no comment, no docstring.
"""

from __future__ import annotations

import ast
import importlib.util
import inspect
import sys
from collections import Counter, defaultdict
from collections.abc import Collection, Container, Iterator, Mapping
from functools import cache
from pathlib import Path
from types import ModuleType

import numpy as np
import scipy.sparse

import roughcontact
from public_names import public_names

SOURCE = Path(roughcontact.__file__).parent
ROOT = Path(__file__).parents[1]


def code_lines(text: str) -> int:
    """Return the number of lines of code of a module."""
    documented = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef
    lines = {
        number
        for number, line in enumerate(text.splitlines(), 1)
        if line.strip() and not line.lstrip().startswith("#")
    }
    documents: set[int] = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(
            node, ast.Constant | ast.JoinedStr
        ):  # a string may hold blank lines, and lines like comments
            lines |= set(range(node.lineno, (node.end_lineno or 0) + 1))
        elif isinstance(node, documented) and ast.get_docstring(node, clean=False) is not None:
            documents |= set(range(node.body[0].lineno, (node.body[0].end_lineno or 0) + 1))
    return len(lines - documents)


def sizes(folder: Path) -> tuple[int, int, int]:
    """Return the number of files, of lines, and of lines of code below a folder."""
    texts = [path.read_text(encoding="utf-8") for path in folder.rglob("*.py")]
    return len(texts), sum(len(text.splitlines()) for text in texts), sum(map(code_lines, texts))


def files_in_folders() -> dict[str, int]:
    """Return the number of modules that each folder of the package has of its own."""
    homes = (path.parent for path in SOURCE.rglob("*.py") if path.name != "__init__.py")
    return dict(Counter(str(home.relative_to(SOURCE)) for home in homes).most_common())


def widths() -> dict[str, int]:
    """Return the number of parameters of each public function and method."""
    found = {}
    for name in public_names():
        if inspect.isfunction(name.value):
            parameters = list(inspect.signature(name.value).parameters)
            found[name.path] = len(parameters) - (parameters[:1] == ["self"])
    return dict(sorted(found.items(), key=lambda item: -item[1]))


def options() -> dict[str, int]:
    """Return the number of options and arguments of each command."""
    from typer.main import get_command

    from roughcontact.cli.app import app

    def walk(words: str, command: object) -> Iterator[tuple[str, int]]:
        below = getattr(command, "commands", None)
        if below is None:
            yield words, len(command.params)  # type: ignore[attr-defined]
            return
        for name in command.list_commands(None):  # type: ignore[attr-defined]
            yield from walk(f"{words} {name}".strip(), command.get_command(None, name))  # type: ignore[attr-defined]

    return dict(sorted(walk("", get_command(app)), key=lambda item: -item[1]))


@cache
def tree(path: Path) -> ast.Module:
    """Return the syntax tree of a file, which is parsed once."""
    return ast.parse(path.read_text(encoding="utf-8"))


def import_graph(source: Path = SOURCE, *, typed: Collection[str] = ()) -> dict[str, set[str]]:
    """Return the modules of a package that each of them imports, in functions too; those in `typed` for types, too.

    A package is imported where a name is taken of it that is none of its modules.
    """
    trees = {}
    for path in source.rglob("*.py"):
        parts = path.relative_to(source.parent).with_suffix("").parts
        trees[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = tree(path)
    return {
        name: set(_imports(tree, trees, typed=name in typed)) & trees.keys() - {name}
        for name, tree in trees.items()
    }


def _imports(tree: ast.AST, known: Container[str], *, typed: bool) -> Iterator[str]:
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            whole = [f"{node.module}.{alias.name}" for alias in node.names]
            yield from (name if name in known else node.module or "" for name in whole)
        elif isinstance(node, ast.expr):
            pass  # holds no statement
        elif not typed and isinstance(node, ast.If) and getattr(node.test, "id", "") == "TYPE_CHECKING":
            yield from _imports(ast.Module(node.orelse, []), known, typed=typed)
        else:
            yield from _imports(node, known, typed=typed)


def circles(graph: Mapping[str, Collection[str]]) -> list[set[str]]:
    """Return the modules that import each other, in a circle each, the largest first."""
    place = {name: number for number, name in enumerate(graph)}
    arrows = [(place[a], place[b]) for a in graph for b in graph[a]]
    rows, columns = np.array(arrows, int).reshape(-1, 2).T
    arrows_of = scipy.sparse.coo_array((np.ones(len(arrows)), (rows, columns)), shape=(len(graph),) * 2)
    _, parts = scipy.sparse.csgraph.connected_components(arrows_of, connection="strong")
    members: dict[int, set[str]] = defaultdict(set)
    for name, part in zip(graph, parts, strict=True):
        members[part].add(name)
    return sorted((names for names in members.values() if len(names) > 1), key=len, reverse=True)


MACHINE_CODE = str(Path("kernels", "calls.py"))


def ways(n: int) -> dict[str, tuple[float, float]]:
    """Return the changes of file and the calls of a press and of a curve, see benchmarks/path.py.

    Both are per call of machine code, whose number follows that of the solver's steps: other processors round
    differently and take up to an eighth more of them.
    """
    path = _script("path")
    traced = {name: path.traced(task) for name, task in path.tasks(n).items()}
    return {
        name: (len(path.changes_of_file(files)) / (count := files.count(MACHINE_CODE)), len(files) / count)
        for name, files in traced.items()
    }


def _script(name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, ROOT / "benchmarks" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


if __name__ == "__main__":
    write = sys.stdout.write
    for part in ("src", "reproduction", "tests", "benchmarks", "docs", "examples"):
        if (ROOT / part).exists():
            write(f"{part:14s} files, lines, lines of code: {sizes(ROOT / part)}\n")
    write(f"files in a folder: {list(files_in_folders().items())[:8]}\n")
    write(f"parameters: {list(widths().items())[:8]}\n")
    write(f"options: {list(options().items())[:12]}\n")
    late, every = import_graph(), import_graph(typed=import_graph())
    write(f"circles: {list(map(len, circles(late)))}, with types {list(map(len, circles(every)))}\n")
    for cells in (64, 256):
        write(f"changes of file and calls, {cells} cells a side: {ways(cells)}\n")
