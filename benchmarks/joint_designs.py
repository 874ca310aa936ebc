"""Write the studies behind the emulator of the stiffness of joints: examples/joint/*.toml.

    python benchmarks/joint_designs.py
    roughcontact study run examples/joint/design.toml --out design     # resumes; 2.5 hours of one core
    python benchmarks/joint_table.py design validation hardness        # the data file of the package

Points of a Sobol sequence over Hurst exponent, side and band, those with six cells a shortest wave on 512 x 512 cells;
each has surfaces of its own.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import tomli_w
from scipy.stats import qmc

from roughcontact.study.cases.joint_case import CELLS

FOLDER = Path(__file__).resolve().parents[1] / "examples" / "joint"
POINTS = 512
HURST, SIDE, BAND = (0.3, 1.2), (4.0, 16.0), (4.0, 8.0)  # L/l and l/l_c in equal ratios
DESIGN, VALIDATION, HARD = 60, 20, 24
HARDNESS = (0.5, 20.0)  # over E* h/l: steel of rms slope 0.1 has 1.7
SEEDS = {"design": 53, "validation": 54, "hardness": 55}


def points(number: int) -> np.ndarray:
    """Return rows (hurst, side, band, hardness), shape (number, 4)."""
    ends = np.array([HURST, np.log(SIDE), np.log(BAND), np.log(HARDNESS)])
    found = qmc.scale(qmc.Sobol(4, scramble=False).random_base2(8)[1:], *ends.T)
    found[:, 1:] = np.exp(found[:, 1:])
    return found[CELLS * found[:, 1] * found[:, 2] <= POINTS][:number].round(4)


def written(name: str, rows: np.ndarray, first: int, samples: int, hard: bool, words: str) -> None:
    """Write a study; the surfaces of each row have a draw of their own."""
    names = ("hurst", "side", "band", *(("hardness",) if hard else ()))
    study = {
        "name": f"joint-{name}",
        "case": "joint",
        "seed": SEEDS[name],
        "samples": samples,
        "parameters": {"points": POINTS},
        "rows": [
            dict(zip(names, map(float, row), strict=False)) | {"draw": first + k}
            for k, row in enumerate(rows)
        ],
    }
    text = f"# {words}\n# Written by benchmarks/joint_designs.py.\n" + tomli_w.dumps(study)
    (FOLDER / f"{name}.toml").write_text(text, encoding="utf-8")


def main() -> None:
    """Write the studies."""
    FOLDER.mkdir(exist_ok=True)
    every = points(DESIGN + VALIDATION + HARD)
    design, validation, hard = np.split(every, [DESIGN, DESIGN + VALIDATION])
    written("design", design, 0, 64, False, "Gaussian surfaces from which the emulator of K/A0 is made.")
    written(
        "validation", validation, 0, 64, False, "Other points and surfaces, which the emulator has not seen."
    )
    written("hardness", hard, 0, 16, True, "First loading of surfaces that flow.")


if __name__ == "__main__":
    main()
