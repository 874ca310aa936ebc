"""What becomes of stores on a disk that is full, and on one that cannot be written; run where mounting is allowed."""

import json
import subprocess
import sys
from pathlib import Path

from roughcontact.study.run import run
from roughcontact.study.store import Store
from roughcontact.study.study import Study
from roughcontact.study.study_errors import StoreError

DISK, LARGE = map(Path, sys.argv[1:])
STUDY = Study(name="a", case="study.trial:CASE", samples=20, parameters={"hurst": 0.5, "points": 300})
FIELDS = Study(name="b", case="study.trial:WITH_FIELDS", samples=60, parameters={"hurst": 0.5})
FOUND = {}


def mount(*options, place=DISK):
    subprocess.run(["mount", "-t", "tmpfs", "-o", ",".join(options), "none", place], check=True)


def attempt(study, folder):
    try:
        return run(study, folder).done
    except StoreError as error:
        return str(error)


def texts(folder):
    with Store.open(folder) as store:
        return [row.text for row in store.rows()]


run(STUDY, LARGE)
mount("size=96k")
FOUND["full"] = attempt(STUDY, DISK / "a")
FOUND["kept"] = len(texts(DISK / "a"))
FOUND["full again"] = attempt(STUDY, DISK / "a")
mount("remount", "ro")
FOUND["readable"] = len(texts(DISK / "a"))
FOUND["read-only"] = attempt(STUDY, DISK / "a")
FOUND["nothing to write"] = attempt(STUDY, DISK / "new")
mount("remount", "rw", "size=16m")
FOUND["room"] = attempt(STUDY, DISK / "a")
FOUND["same"] = texts(DISK / "a") == texts(LARGE)

(DISK / "b" / "fields").mkdir(parents=True)
mount("size=100k", place=DISK / "b" / "fields")
FOUND["fields"] = attempt(FIELDS, DISK / "b")
with Store.open(DISK / "b") as store:
    FOUND["fields kept"] = [store.fields(key)["pressure"].shape == (50, 70) for key in store.done_keys()]
FOUND["files"] = sum(1 for _ in (DISK / "b" / "fields").iterdir())
mount("size=4k")
FOUND["no room at all"] = attempt(STUDY, DISK / "a")
json.dump(FOUND, sys.stdout)
