"""One run in a process of its own: its peak memory.

python -m suite.alone FOLDER, of a folder that `peak_alone` wrote.
"""

from __future__ import annotations

import json
import os
import pickle
import resource
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from suite.cases import Problem
    from suite.programs import Program

__all__ = ["peak", "peak_alone"]

HOME = Path(__file__).parents[1]


def peak() -> float:
    """Return the peak resident memory of this process [MB]."""
    status = Path("/proc/self/status")
    if status.exists():  # getrusage would count what the parent held when it started this process
        line = next(line for line in status.read_text().splitlines() if line.startswith("VmHWM"))
        return int(line.split()[1]) * 1024 / 1e6
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit / 1e6


def peak_alone(program: Program, kind: str, problem: Problem, tolerance: float) -> float | None:
    """Return the peak memory of a process that loads the heights and solves once [MB]; None if it fails."""
    import numpy as np

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        np.save(folder / "heights.npy", problem.heights)
        rest = replace(problem, heights=None)  # type: ignore[arg-type]
        home = str(Path(str(program.adapter.__file__)).parent)
        (folder / "rest").write_bytes(pickle.dumps((program.name, home, kind, rest, tolerance)))
        path = os.pathsep.join([str(HOME), *filter(None, [os.environ.get("PYTHONPATH")])])
        done = subprocess.run(
            [sys.executable, "-m", "suite.alone", name],
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, "PYTHONPATH": path},
        )
    return None if done.returncode else float(json.loads(done.stdout.splitlines()[-1]))


def main(folder: Path) -> None:
    """Solve what the folder holds and print the peak."""
    import numpy as np

    from suite.programs import Program, load

    name, home, kind, rest, tolerance = pickle.loads((folder / "rest").read_bytes())
    program: Any = load(name, Path(home))
    assert isinstance(program, Program), program
    solve: Any = program.solver(kind)
    solve(replace(rest, heights=np.load(folder / "heights.npy")), tolerance)
    print(peak())


if __name__ == "__main__":
    main(Path(sys.argv[1]))
