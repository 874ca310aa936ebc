"""Install what pyproject.toml asks for, here and in reproduction/; pip is called only where that has changed.

python .ci/install.py STAMP WORDS [EXTRA ...]

The file STAMP holds a digest of what was installed. WORDS are printed before pip is called. Without a network pip gives
up after a few tries: then what is installed is used if it suits, and otherwise one line names what is lacking.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import subprocess
import sys
import tomllib
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from pip._vendor.packaging.requirements import Requirement

# Of the package, and of that of the thesis' figures.
FOLDERS = (".", "./reproduction")
# Wheels only: nothing is built here, and a missing wheel is an error at once. Python compiles what is imported.
PIP = ("-m", "pip", "install", "-q", "--disable-pip-version-check", "--only-binary=:all:", "--no-compile")


def main(stamp: Path, words: str, *extras: str) -> None:
    """Install both packages, and some extras of the first, in place."""
    tables = [tomllib.loads(Path(each, "pyproject.toml").read_text(encoding="utf-8")) for each in FOLDERS]
    first, *others = (table["project"] for table in tables)
    asked = [[table["project"], table["build-system"], table["tool"]["hatch"]] for table in tables]
    wanted = json.dumps([asked, extras], sort_keys=True)
    digest = hashlib.sha256(wanted.encode()).hexdigest()
    if stamp.exists() and stamp.read_text(encoding="utf-8") == digest:
        stamp.touch()
        return
    print(words, flush=True)
    targets = [f"{FOLDERS[0]}[{','.join(extras)}]" if extras else FOLDERS[0], *FOLDERS[1:]]
    command = [sys.executable, *PIP, *(word for target in targets for word in ("-e", target))]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode == 0:
        stamp.write_text(digest, encoding="utf-8")
        return
    required = [first["dependencies"], *(first["optional-dependencies"][extra] for extra in extras)]
    required.append([first["name"], *(project["name"] for project in others)])
    lacking = [text for texts in required for text in texts if is_lacking(text)]
    reason = (re.findall(r"ERROR: (.*)", done.stderr) or done.stderr.split("\n"))[-1] or "it failed"
    if lacking:
        sys.exit(
            f"pip cannot install {', '.join(lacking)} ({reason}): call make again where there is a network"
        )
    print(f"pip cannot look for newer packages ({reason}): what is installed is used", flush=True)


def is_lacking(text: str) -> bool:
    """Return whether a requirement for this Python is not met."""
    requirement = Requirement(text)
    if requirement.marker is not None and not requirement.marker.evaluate():
        return False
    try:
        return not requirement.specifier.contains(version(requirement.name), prereleases=True)
    except PackageNotFoundError:
        return True


if __name__ == "__main__":
    os.chdir(Path(__file__).parent.parent)
    main(Path(sys.argv[1]), *sys.argv[2:])
