"""Print the tests that `make check` runs: those of the whole house, and those named like a file that has changed.

Those are what is not committed yet; where all is, what the last commit changed.
"""

from __future__ import annotations

import subprocess
from pathlib import Path

HOME = Path(__file__).parent.parent
TESTS = (HOME / "tests", HOME / "reproduction" / "tests")  # each beside the folder of its code
# What looks at every file, every public name with its examples, and every number at the border.
HOUSE = ("structure", "docstrings", "links", "release", "bad_input", "validation", "late", "typed")


def git(*words: str) -> list[str]:
    """Return the lines that git answers; none where it knows no answer."""
    done = subprocess.run(["git", "-C", HOME, *words], capture_output=True, text=True, check=False)
    return done.stdout.splitlines() if done.returncode == 0 else []


def changed() -> list[Path]:
    """Return the files of this checkout that have changed."""
    names = git("diff", "--name-only", "HEAD") + git("ls-files", "--others", "--exclude-standard")
    return [HOME / name for name in names or git("diff", "--name-only", "HEAD~1")]


def tests() -> set[Path]:
    """Return the files of tests."""
    found = {HOME / "tests" / f"test_{name}.py" for name in HOUSE}
    for path in changed():
        if path.name.startswith("test_"):
            found |= {path} if path.exists() else set()
        elif path.suffix == ".py" and any(path.is_relative_to(folder.parent / "src") for folder in TESTS):
            found |= {each for folder in TESTS for each in folder.rglob(f"test_{path.name}")}
    return found


if __name__ == "__main__":
    print(*sorted(path.relative_to(HOME) for path in tests()))
