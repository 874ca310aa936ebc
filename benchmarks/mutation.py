"""Mutation score of the tests: changes of the code, one at a time, and whether a test fails.

    python benchmarks/mutation.py --store FOLDER [--count 400] [--seed 0] [--rooms solver,contact] [--minutes 60]
        [--processes 2]
    python benchmarks/mutation.py --store FOLDER --whole     # once more against all tests, those that survived
    python benchmarks/mutation.py --store FOLDER --report

Mutants of the rooms are drawn at random, in proportion to their places: a comparison or an operator becomes another
one, a condition its opposite, a number its neighbour, a returned value None, a call by itself nothing. Each is tried
with the tests of its room that run its line, quick ones first, then with those that run its file, until one fails.
Lines and times are measured once (ROOM.coverage and ROOM.xml in the store). The store is a line of JSON a mutant: a run
that was stopped goes on where it was.
Survivors that cannot change an answer are listed with the reason in ``benchmarks/mutation-equivalent.toml``, by their
file and the changed line; they leave the score.
"""

from __future__ import annotations

import argparse
import ast
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import threading
import time
import tomllib
import xml.etree.ElementTree as ET
from collections import defaultdict
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from itertools import chain
from pathlib import Path
from queue import SimpleQueue

from coverage import CoverageData

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "src" / "roughcontact"
EQUIVALENT = Path(__file__).with_name("mutation-equivalent.toml")
ROOMS = ("solver", "contact", "adhesion", "halfspace", "files")
SLOWER = 4  # times the tests' own seconds: a mutant that takes more processor time hangs, and counts as found
START = 60  # [s] for the start of the tests, and what is measured badly
WAIT = 3600.0  # [s] for a mutant that waits for ever
COMPARED = {
    ast.Lt: "<=", ast.LtE: "<", ast.Gt: ">=", ast.GtE: ">", ast.Eq: "!=", ast.NotEq: "==",
    ast.Is: "is not", ast.IsNot: "is", ast.In: "not in", ast.NotIn: "in",
}  # fmt: skip
COMPUTED = {
    ast.Add: "-", ast.Sub: "+", ast.Mult: "/", ast.Div: "*", ast.FloorDiv: "*", ast.Mod: "*", ast.Pow: "*",
    ast.BitAnd: "|", ast.BitOr: "&",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Mutant:
    """One change: the characters from `start` to `end` of a file become other ones."""

    room: str
    file: str
    line: int
    start: int
    end: int
    kind: str
    new: str

    @property
    def name(self) -> str:
        """Where it is, and what it changes."""
        return f"{self.file}:{self.line}:{self.start} {self.kind}"

    def applied(self, text: str) -> str:
        """Return the text of its file with the change."""
        return text[: self.start] + self.new + text[self.end :]

    def changed(self, text: str) -> str:
        """Return its file and the line with the change, which stay the same when other lines are edited."""
        whole = self.applied(text)
        line = whole[whole.rfind("\n", 0, self.start) + 1 :].partition("\n")[0]
        return f"{self.file}: {line.strip()}"


def mutants(path: Path, room: str) -> Iterator[Mutant]:
    """Yield every mutant of a file."""
    text = path.read_text(encoding="utf-8")
    lines = [0]
    for line in text.splitlines(keepends=True):
        lines.append(lines[-1] + len(line))
    encoded = [line.encode() for line in text.splitlines(keepends=True)]

    def place(line: int, column: int) -> int:
        return lines[line - 1] + len(encoded[line - 1][:column].decode())

    def span(node: ast.expr | ast.stmt) -> tuple[int, int]:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        return place(node.lineno, node.col_offset), place(node.end_lineno, node.end_col_offset)

    def change(node: ast.expr | ast.stmt, start: int, end: int, kind: str, new: str) -> Mutant:
        return Mutant(room, path.relative_to(PACKAGE).as_posix(), node.lineno, start, end, kind, new)

    def between(left: ast.expr, right: ast.expr, kind: str, new: str) -> Iterator[Mutant]:
        start, end = span(left)[1], span(right)[0]
        gap = text[start:end]
        sign = gap.strip(" ()\n\\")
        if "#" not in gap and sign and gap.count(sign) == 1:  # brackets around both sides stay
            at = start + gap.index(sign)
            yield change(left, at, at + len(sign), kind, new)

    def of(node: ast.AST) -> Iterator[Mutant]:
        match node:
            case ast.Compare(left=left, ops=[operation], comparators=[right]):
                yield from between(left, right, "comparison", COMPARED[type(operation)])
            case ast.BinOp(left=left, op=operation, right=right):
                if (new := COMPUTED.get(type(operation))) is not None:
                    yield from between(left, right, "operator", new)
            case ast.BoolOp(op=operation, values=[left, right, *_]):
                yield from between(left, right, "and/or", "or" if isinstance(operation, ast.And) else "and")
            case ast.UnaryOp(op=ast.Not() | ast.USub() as sign):
                start = span(node)[0]
                yield change(node, start, start + (4 if isinstance(sign, ast.Not) else 1), "sign", "")
            case ast.If(test=test) | ast.IfExp(test=test) | ast.While(test=test):
                start, end = span(test)
                yield change(test, start, end, "condition", f"(not ({text[start:end]}))")
            case ast.Constant(value=bool(value)):
                yield change(node, *span(node), "constant", str(not value))
            case ast.Constant(value=int(value) | float(value)):
                yield change(
                    node,
                    *span(node),
                    "constant",
                    repr(value + 1 if isinstance(value, int) else 2 * value or 1.0),
                )
            case ast.Return(value=ast.expr() as value) if not is_none(value):
                yield change(node, *span(value), "return", "None")
            case ast.Expr(value=ast.Call()):
                yield change(node, *span(node), "call", "pass")

    tree = ast.parse(text)
    for node in running(tree):
        yield from of(node)


def is_none(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and node.value is None


def running(tree: ast.AST) -> Iterator[ast.AST]:
    """Yield the nodes that run: no annotations, no texts of errors, nothing for type checkers, no lists of names."""
    for name, field in ast.iter_fields(tree):
        if name in ("annotation", "returns", "decorator_list", "type_params", "exc"):
            continue
        for node in field if isinstance(field, list) else [field]:
            if not isinstance(node, ast.AST) or isinstance(node, ast.JoinedStr | ast.AnnAssign):
                continue
            if (
                isinstance(node, ast.If)
                and isinstance(node.test, ast.Name)
                and node.test.id == "TYPE_CHECKING"
            ):
                continue
            if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) in ("__all__", "__slots__"):
                continue
            yield node
            yield from running(node)


def drawn(rooms: tuple[str, ...], count: int, seed: int) -> list[Mutant]:
    """Return mutants of rooms, drawn at random without repetition."""
    every = [
        mutant
        for room in rooms
        for path in sorted((PACKAGE / room).rglob("*.py"))
        for mutant in mutants(path, room)
    ]
    print(f"{len(every)} mutants in {', '.join(rooms)}", flush=True)
    return random.Random(seed).sample(every, min(count, len(every)))


@dataclass(frozen=True)
class Bench:
    """A copy of the package in which one mutant at a time is tried."""

    home: Path

    def prepare(self) -> None:
        """Copy the package."""
        shutil.rmtree(self.home, ignore_errors=True)
        shutil.copytree(PACKAGE, self.home / "roughcontact", ignore=shutil.ignore_patterns("__pycache__"))

    def tried(self, mutant: Mutant, tests: list[str], limit: float) -> str:
        """Return whether tests found a mutant within some seconds: "found", "hung" or "survived"."""
        path = self.home / "roughcontact" / mutant.file
        whole = path.read_text(encoding="utf-8")
        path.write_text(mutant.applied(whole), encoding="utf-8")
        try:
            done = self.pytest("-x", *tests, limit=f"{limit:.0f}")
            if done.returncode > 4:  # no test ran; 4 is a file that is not imported, below zero is a crash
                raise RuntimeError(done.stdout.decode()[-2000:])
            return {0: "survived", -signal.SIGXCPU: "hung"}.get(done.returncode, "found")
        except subprocess.TimeoutExpired:
            return "hung"
        finally:
            path.write_text(whole, encoding="utf-8")

    def pytest(
        self, *words: str, limit: str = "unlimited", **variables: str
    ) -> subprocess.CompletedProcess[bytes]:
        """Run tests on the copy, for so many seconds of processor time at most."""
        paths = os.pathsep.join([str(self.home), str(ROOT / "reproduction" / "src")])
        threads = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "1")
        environment = os.environ | threads | {"PYTHONPATH": paths, "PYTHONDONTWRITEBYTECODE": "1"}
        limited = ["sh", "-c", 'ulimit -S -t "$0" && exec "$@"', limit]
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--no-header", *words]
        return subprocess.run(
            [*limited, *command],
            cwd=ROOT,
            env=environment | variables,
            capture_output=True,
            timeout=WAIT,
            check=False,
        )

    def covered(self, store: Path, room: str) -> Covered:
        """Return which tests of a room run which lines of it, and how long they take."""
        file, times = store / f"{room}.coverage", store / f"{room}.xml"
        if not times.exists():
            measured = f"--cov={self.home / 'roughcontact' / room}", "--cov-context=test", "--cov-report="
            done = self.pytest(*measured, f"--junitxml={times}", f"tests/{room}", COVERAGE_FILE=str(file))
            if done.returncode:
                times.unlink(missing_ok=True)
                raise RuntimeError(
                    f"the tests of {room} fail without a mutant: {done.stdout.decode()[-2000:]}"
                )
        data = CoverageData(str(file))
        data.read()
        seconds: defaultdict[str, float] = defaultdict(float)
        for case in ET.parse(times).iter("testcase"):
            seconds[f"{case.get('classname')}.{case.get('name', '').partition('[')[0]}"] += float(
                case.get("time", 0)
            )
        return Covered(data, self.home / "roughcontact", seconds)


@dataclass(frozen=True)
class Covered:
    """The lines that the tests of a room run, and the seconds that they take."""

    data: CoverageData
    package: Path
    seconds: defaultdict[str, float]

    def tests_of(self, mutant: Mutant) -> Iterator[tuple[list[str], float]]:
        """Yield tests, the quickest first, and after how many seconds a mutant hangs in them.

        First those that run its line, then those that run another one of its file: a line whose answer is kept runs in
        the first test that wants it. They are all of its room where the line runs on import.
        """
        lines = self.data.contexts_by_lineno(str(self.package / mutant.file))
        line = max((line for line in lines if line <= mutant.line), default=0)  # where its statement begins
        first = _tests(lines.get(line, []))
        if not first:
            yield [f"tests/{mutant.room}"], START + SLOWER * sum(self.seconds.values())
            return
        for tests in (first, _tests(chain.from_iterable(lines.values())) - first):
            taken = {
                test: self.seconds[test.replace(".py::", ".").replace("/", ".").replace("::", ".")]
                for test in tests
            }
            if tests:
                quick = sorted(tests, key=lambda test: (taken[test], test))
                yield quick, START + SLOWER * sum(taken.values())


def _tests(contexts: Iterable[str]) -> set[str]:
    """Return the tests of contexts, whatever their parameters; an empty one is that of the import."""
    return {context.partition("|")[0].partition("[")[0] for context in contexts if context}


def read(store: Path) -> dict[str, dict[str, object]]:
    """Return the results by the names of the mutants; later lines count."""
    if not store.exists():
        return {}
    rows = map(json.loads, store.read_text(encoding="utf-8").splitlines())
    return {row["name"]: row for row in rows}


def report(rows: dict[str, dict[str, object]]) -> None:
    """Print the score of each room and the survivors."""
    known = tomllib.loads(EQUIVALENT.read_text(encoding="utf-8")) if EQUIVALENT.exists() else {}
    for room in (*ROOMS, "all"):
        of = {name: row for name, row in rows.items() if room in ("all", row["room"])}
        left = {name for name, row in of.items() if row["result"] == "survived"}
        same = {name for name in left if of[name]["changed"] in known}
        counted = len(of) - len(same)
        if counted:
            found = len(of) - len(left)
            print(
                f"{room:10s} {found:4d} of {counted:4d} found, {found / counted:.1%}; {len(same)} equivalent"
            )
    for name, row in sorted(rows.items()):
        if row["result"] == "survived":
            print(f"survived: {name} {row['changed']!r} {known.get(row['changed'], '')}")


def main() -> None:
    """Run it."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--store", type=Path, required=True)
    parser.add_argument("--count", type=int, default=400)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--rooms", default=",".join(ROOMS))
    parser.add_argument("--minutes", type=float, default=1e6)
    parser.add_argument("--processes", type=int, default=1, help="mutants tried at once")
    parser.add_argument("--whole", action="store_true")
    parser.add_argument("--report", action="store_true")
    chosen = parser.parse_args()
    chosen.store = chosen.store.resolve()
    chosen.store.mkdir(parents=True, exist_ok=True)
    store = chosen.store / "mutants.jsonl"
    rows = read(store)
    if chosen.report:
        report(rows)
        return
    results = {name: row["result"] for name, row in rows.items()}
    sought = "survived" if chosen.whole else None
    sample = drawn(tuple(chosen.rooms.split(",")), chosen.count, chosen.seed)
    wanted = [mutant for mutant in sample if results.get(mutant.name) == sought]
    benches: SimpleQueue[Bench] = SimpleQueue()
    for number in range(chosen.processes):
        bench = Bench(chosen.store / f"copy{number}")
        bench.prepare()
        benches.put(bench)
    rooms = () if chosen.whole else {mutant.room for mutant in wanted}
    covered = {room: Bench(chosen.store / "copy0").covered(chosen.store, room) for room in sorted(rooms)}
    until = time.monotonic() + 60 * chosen.minutes
    writing = threading.Lock()

    def work(mutant: Mutant) -> None:
        if time.monotonic() > until:
            return
        everything = [(["-n", "auto", "tests", "reproduction/tests"], 1e9)]
        tries = everything if chosen.whole else covered[mutant.room].tests_of(mutant)
        bench, start = benches.get(), time.monotonic()
        try:
            results = (bench.tried(mutant, tests, limit) for tests, limit in tries)
            result = next((each for each in results if each != "survived"), "survived")
        finally:
            benches.put(bench)
        seconds = round(time.monotonic() - start, 1)
        changed = mutant.changed((PACKAGE / mutant.file).read_text(encoding="utf-8"))
        measured = {"changed": changed, "result": result, "seconds": seconds}
        with writing, store.open("a", encoding="utf-8") as file:
            file.write(json.dumps({"name": mutant.name, **asdict(mutant), **measured}) + "\n")
        print(f"{result:8s} {seconds:6.1f} s  {mutant.name} -> {mutant.new!r}", flush=True)

    with ThreadPoolExecutor(chosen.processes) as pool:
        list(pool.map(work, wanted))
    report(read(store))


if __name__ == "__main__":
    main()
