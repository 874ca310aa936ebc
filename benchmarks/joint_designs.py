"""Write the studies behind the emulator of the stiffness of joints: examples/joint/*.toml.

    python benchmarks/joint_designs.py
    roughcontact study run examples/joint/design.toml --out design     # resumes; 2.5 hours of one core
    python benchmarks/joint_table.py --take FOLDER                     # of the stores: the table of the package

Points of a Sobol sequence over Hurst exponent, side and band, those with six cells a shortest wave on 512 x 512 cells;
each has surfaces of its own.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import tomli_w
from scipy.stats import qmc

from roughcontact.measurement.joint_emulator import BAND, HURST, LEAST_AREA, SIDE
from roughcontact.study.cases.joint_case import CELLS

FOLDER = Path(__file__).resolve().parents[1] / "examples" / "joint"
POINTS = 512
NAMES = ("hurst", "side", "band", "hardness")
DESIGN, VALIDATION, HARD, CALIBRATION = 60, 20, 24, 400
HARDNESS = (0.5, 20.0)  # over E* h/l: steel of rms slope 0.1 has 1.7
SEEDS = {"design": 53, "validation": 54, "hardness": 55, "calibration": 56, "large": 57}
LARGE = {"points": 2048, "hurst": 0.8, "side": 32.0, "band": 8.0}
SIDES = (
    11.3,
    0.17,
)  # of the joints of the calibration: median and standard deviation of the logarithm; 8 at least


def points(number: int) -> list[dict[str, float]]:
    """Return the first rows of the sequence."""
    ends = np.array([HURST, np.log(SIDE), np.log(BAND), np.log(HARDNESS)])
    found = qmc.scale(qmc.Sobol(4, scramble=False).random_base2(8)[1:], *ends.T)
    found[:, 1:] = np.exp(found[:, 1:])
    kept = found[CELLS * found[:, 1] * found[:, 2] <= POINTS][:number].round(4)
    return [dict(zip(NAMES, map(float, row), strict=True)) for row in kept]


def written(name: str, rows: list[dict[str, float]], samples: int, words: str) -> None:
    """Write a study; the surfaces of each row have a draw of their own."""
    study = {
        "name": f"joint-{name}",
        "case": "joint",
        "seed": SEEDS[name],
        "samples": samples,
        "rows": [{"points": POINTS} | row | {"draw": k} for k, row in enumerate(rows)],
    }
    text = f"# {words}\n# Written by benchmarks/joint_designs.py.\n" + tomli_w.dumps(study)
    (FOLDER / f"{name}.toml").write_text(text, encoding="utf-8")


def joints(number: int) -> list[dict[str, float]]:
    """Return rows of the calibration, drawn from the prior that it states."""
    rng = np.random.default_rng(SEEDS["calibration"])
    found = []
    while len(found) < number:
        side = SIDES[0] * np.exp(SIDES[1] * rng.standard_normal())
        hurst, band = rng.uniform(*HURST), np.exp(rng.uniform(*np.log(BAND)))
        if side >= LEAST_AREA**0.5:
            cells = 64 * int(np.ceil(CELLS * side * band / 64))
            row = {"hurst": hurst, "side": side, "band": band}
            found.append(
                {name: round(value, 4) for name, value in row.items()} | {"points": max(POINTS, cells)}
            )
    return found


def main() -> None:
    """Write the studies."""
    FOLDER.mkdir(exist_ok=True)
    every = points(DESIGN + VALIDATION + HARD)
    elastic = [{name: row[name] for name in NAMES[:3]} for row in every]
    design, validation = elastic[:DESIGN], elastic[DESIGN : DESIGN + VALIDATION]
    written("design", design, 64, "Gaussian surfaces from which the emulator of K/A0 is made.")
    written("validation", validation, 64, "Other points and surfaces, which the emulator has not seen.")
    written("hardness", every[DESIGN + VALIDATION :], 16, "First loading of surfaces that flow.")
    written("large", [LARGE], 20, "Joints of 1 024 l^2, larger than any of the design.")
    written("calibration", joints(CALIBRATION), 1, "Joints drawn from the prior, one specimen each.")


if __name__ == "__main__":
    main()
