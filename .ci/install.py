"""Install what pyproject.toml asks for into the environment of this Python; pip is called only where that has changed.

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

# Wheels only: nothing is compiled here, and a missing wheel is an error at once.
PIP = ("-m", "pip", "install", "-q", "--disable-pip-version-check", "--only-binary=:all:", "-e")


def main(stamp: Path, words: str, *extras: str) -> None:
    """Install the package and some of its extras, in place."""
    tables = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))
    project = tables["project"]
    wanted = json.dumps([project, tables["build-system"], tables["tool"]["hatch"], extras], sort_keys=True)
    digest = hashlib.sha256(wanted.encode()).hexdigest()
    if stamp.exists() and stamp.read_text(encoding="utf-8") == digest:
        stamp.touch()
        return
    print(words, flush=True)
    target = f".[{','.join(extras)}]" if extras else "."
    done = subprocess.run([sys.executable, *PIP, target], capture_output=True, text=True, check=False)
    if done.returncode == 0:
        stamp.write_text(digest, encoding="utf-8")
        return
    required = [project["dependencies"], *(project["optional-dependencies"][extra] for extra in extras)]
    lacking = [text for texts in required for text in texts if is_lacking(text)]
    if is_lacking(project["name"]):
        lacking.append(project["name"])
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
