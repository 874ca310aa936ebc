"""Make keys and stores as they are on the disks of users: those of this folder were made by the build before recipes.

To freeze a case that is new, give its parameters here and add its keys: ``python tests/study/frozen/make.py FOLDER``
makes all of it in another folder.
"""

import hashlib
import json
import sys
from pathlib import Path

from roughcontact.study.cases import find_case
from roughcontact.study.run import run
from roughcontact.study.store import Store
from roughcontact.study.study import Study
from roughcontact.study.task import canonical, key_of

LAW = Path(__file__).parents[3] / "examples" / "law"
SQUARE = {"points": 16, "size": "1 mm", "rms": "1 um", "hurst": 0.8}
OTHER = {
    **{"points": 32, "size": 2, "rms": 0.01, "hurst": 1, "rms_band": [1, 0.2], "rolloff": 0.5},
    **{"long_cutoff": 0.9, "short_cutoff": 0.1, "amplitudes": "gaussian", "periodic": True, "radius": "5 mm"},
}
PRESSED, HARD = {**SQUARE, "modulus": "1 GPa"}, {"hardness": "10 MPa"}
SOFT = {**OTHER, "modulus": 1, "relative_hardness": 0.2}
MADE = {"kind": "self-affine", "hurst": 0.8, "rms": "1 um", "size": "1 mm", "points": 16}
FORCES = {"lowest_force": 1e-3, "highest_force": 1, "loads": 3, "tolerance": 1e-6}
STUCK = {**PRESSED, "work": "50 mJ/m^2", "range": "20 nm"}
GIVEN = {
    "adhesion": [
        STUCK,
        {**OTHER, "modulus": 1, "work": 1e-6, "range": 0.1, "law": "dugdale", "turn": 2},
        {**STUCK, "allow_unresolved": True, "loads": 4, "tolerance": 1e-6},
    ],
    "asperities": [{"hurst": 0.8, "points": 16}, {"hurst": 1, "points": 32, "loads": 4, "highest_force": 1}],
    "cells": [PRESSED, SOFT | FORCES, {**PRESSED, "rolloff": 0.25}],
    "curve": [PRESSED, PRESSED | HARD | FORCES, SOFT, {**PRESSED, "loads": 3, "points": 17}],
    "job": [
        {"job": "curve", "source": MADE, "bodies": {"modulus": 1e9}, "preparation": {"level": "plane"}},
        {"job": "press", "source": MADE, "bodies": {"materials": "steel,rigid"}, "load": {"force": "1 N"}},
    ],
    "joint": [
        {"hurst": 0.8, "side": 2, "band": 2, "points": 24, "loads": 3},
        {"hurst": 0.5, "side": 8, "band": 6, "hardness": 2.0, "draw": 7},
    ],
    "lines": [{"hurst": 0.8, "points": 64}, {"hurst": -1, "points": 8, "lines": 2, "loads": 2}],
    "loop": [PRESSED | HARD, SOFT | FORCES, {**PRESSED, **HARD, "flow": "raised"}],
    "patch": [{**PRESSED, "period": 2}, {**PRESSED, **HARD, "period": 4, "rolloff": 0.5}],
    "slip": [
        PRESSED,
        {**OTHER, "modulus": 1, "poisson_ratio": 0.5, "friction": 1, "pulls": 2} | FORCES,
    ],
    "yielding": [PRESSED, SOFT, {**PRESSED, **HARD, "lowest_depth": 1, "loads": 2, "tolerance": 1e-4}],
}
_TWO = {"hurst": [0.5, 1.0]}
STORED = {  # by their case: parameters and table
    "adhesion": ({**STUCK, "rms": "50 nm", "work": "5 mJ/m^2", "range": "200 nm", "loads": 3}, {}),
    "curve": ({**PRESSED, "loads": 3}, _TWO),
    "lines": ({"points": 32, "lines": 2, "loads": 3}, _TWO),
    "loop": ({**PRESSED, "relative_hardness": 0.3, "loads": 2}, {}),
}


def keys(name):
    """Return what is frozen of the parameters of a case."""
    case = find_case(name)
    found = []
    for given in GIVEN[name]:
        text = canonical(case.parameters(**given))
        key = key_of(case, text, seed=3, sample=7)
        found.append({"given": given, "canonical": text, "key": key})
    return found


def fingerprint(study):
    """Return one fingerprint of all keys of a study."""
    return hashlib.sha256("".join(task.key for task in study.tasks()).encode()).hexdigest()


def store(folder, name):
    """Compute half of a small study: the first of two samples."""
    parameters, table = STORED[name]
    if "hurst" in table:
        parameters = {key: value for key, value in parameters.items() if key != "hurst"}
    study = Study(name=f"frozen-{name}", case=name, seed=3, parameters=parameters, table=table)
    run(study, folder / name)
    with Store.open(folder / name, study.with_samples(2)):
        pass
    (folder / name / "lock").unlink(missing_ok=True)


if __name__ == "__main__":
    here = Path(sys.argv[1])
    every = {name: keys(name) for name in GIVEN}
    law = {path.stem: fingerprint(Study.read(path)) for path in sorted(LAW.glob("*.toml"))}
    (here / "keys.json").write_text(json.dumps({"cases": every, "law": law}, indent=1) + "\n")
    for name in STORED:
        store(here, name)
