"""Coverage-guided fuzzing of the readers of files: any bytes are read or refused, and nothing else.

    python -m pip install atheris                             # Linux and macOS
    python benchmarks/fuzz.py FOLDER --kinds .gsf,.sur --minutes 120
    python benchmarks/fuzz.py FOLDER --report                 # minutes, inputs and findings of each reader so far

For each extension libFuzzer changes small files of that format, in FOLDER/EXTENSION, and keeps what reaches new
lines of `roughcontact.files`. A finding is any error but a `ReadError`, an answer that is no surface, more than
two gigabytes, or more than twenty seconds: its input stays in FOLDER as crash-..., oom-... or timeout-... A run
goes on where the last ended.
"""

import argparse
import json
import re
import subprocess
import sys
import tempfile
import time
import warnings
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
KINDS = ".gsf,.gwy,.sdf,.tmd,.tiff,.sur,.x3p,.npy,.npz,.nc,.txt,.csv,.xyz,.grd,.zip,.001,.mat,.h5"


def seeds(kind: str) -> list[bytes]:
    """Return the small files of a format that the tests write; without one to change nothing would be reached."""
    from files.written import FILES

    found = [file.data for file in FILES.values() if Path(file.name).suffix == kind]
    if not found:
        raise SystemExit(f"the tests write no file {kind}")
    return found


def fuzz(kind: str, home: Path, seconds: int) -> None:
    """Fuzz one reader until its time is over or something is found; libFuzzer ends the process."""
    import atheris

    with atheris.instrument_imports(include=["roughcontact.files"]):
        import roughcontact.files.dispatch
        import roughcontact.files.read
    import numpy as np

    import roughcontact as rc

    warnings.simplefilter("ignore")
    corpus, place = home / kind, Path(tempfile.mkdtemp())
    corpus.mkdir(parents=True, exist_ok=True)
    for number, data in enumerate(seeds(kind)):
        (corpus / f"seed-{number}").write_bytes(data)
    file = place / f"fuzzed{kind}"

    def one(data: bytes) -> None:
        file.write_bytes(data)
        try:
            found = rc.read(file, unit="um", size=1e-3)
        except rc.ReadError as error:
            if "unit" not in (error.place or ""):
                return
            try:
                found = rc.read(file)  # it states what was given
            except rc.ReadError:
                return
        assert np.ndim(found.heights) == 2
        assert not np.isinf(found.heights).any()
        assert min(found.grid.spacing) > 0

    limits = ["-timeout=20", "-rss_limit_mb=2048", "-max_len=65536", f"-max_total_time={seconds}"]
    atheris.Setup([sys.argv[0], *limits, f"-artifact_prefix={home}/", str(corpus)], one)
    atheris.Fuzz()


def run(kind: str, home: Path, minutes: float) -> None:
    """Fuzz one reader in a process of its own, and write a line about it."""
    start = time.monotonic()
    words = [sys.executable, __file__, str(home), "--kinds", kind, "--minutes", str(minutes), "--inside"]
    done = subprocess.run(words, stderr=subprocess.PIPE, check=False)
    log = done.stderr.decode(errors="replace")
    (home / f"{kind[1:]}.log").write_text(log)
    tried = re.findall(r"^#(\d+)\t", log, re.MULTILINE)
    row = {
        "kind": kind,
        "minutes": round((time.monotonic() - start) / 60, 1),
        "inputs": int(tried[-1]) if tried else 0,
        "corpus": len(list((home / kind).iterdir())),
        "finding": done.returncode != 0,
    }
    print(json.dumps(row), flush=True)
    with (home / "runs.jsonl").open("a") as runs:
        runs.write(json.dumps(row) + "\n")


def report(home: Path) -> None:
    """Print minutes, inputs and findings of each reader."""
    rows = [json.loads(line) for line in (home / "runs.jsonl").read_text().splitlines()]
    print("| extension | minutes | inputs | kept | runs that ended with a finding |\n|---|---|---|---|---|")
    for kind in dict.fromkeys(row["kind"] for row in rows):
        of = [row for row in rows if row["kind"] == kind]
        minutes, inputs = (sum(row[name] for row in of) for name in ("minutes", "inputs"))
        found = sum(row["finding"] for row in of)
        print(f"| {kind} | {minutes:.0f} | {inputs} | {of[-1]['corpus']} | {found} |")


def main() -> None:
    """Run it."""
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--kinds", default=KINDS)
    parser.add_argument("--minutes", type=float, default=120)
    parser.add_argument("--report", action="store_true")
    parser.add_argument("--inside", action="store_true", help=argparse.SUPPRESS)
    chosen = parser.parse_args()
    home = chosen.folder.resolve()
    home.mkdir(parents=True, exist_ok=True)
    if chosen.report:
        report(home)
    elif chosen.inside:
        fuzz(chosen.kinds, home, round(60 * chosen.minutes))
    else:
        for kind in chosen.kinds.split(","):
            run(kind, home, chosen.minutes)


if __name__ == "__main__":
    main()
