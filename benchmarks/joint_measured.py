"""Measured closures of fractures in rock, held against the model of `rc.infer_joint`.

    python benchmarks/joint_measured.py FOLDER/*_stress_closure.txt [--faces LOWER UPPER]

Files of the public repository danielvogler/hm_coupled_fracture_response (granodiorite; Vogler and others, J. Geophys.
Res. Solid Earth 123, 1186 (2018)): number, displacement [mm] and normal stress [MPa], first up, then down. Specimens
of 122 mm; Young's modulus 10 to 12 GPa measured, Poisson's ratio 0.33 assumed. The resolution is not stated: 1 um is
assumed. Mated faces of a fracture are no Gaussian joint: the answer expected before the first run is "not this model".

With maps of both faces (any file that `rc.read` takes) the faces are shifted until they fit, combined and pressed: the
closures of the first loading stand beside the measured ones, both since the first load.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import numpy as np

import roughcontact as rc

YOUNG, POISSON, ERROR = 11e9, 0.33, 0.1
RESOLUTION = 1e-6
AREA = math.pi * 0.061**2


def branches(path: Path) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Return pressures [Pa] and closures [m] of both branches, in the order of increasing pressure."""
    rows = [line.split(",") for line in path.read_text(encoding="utf-8").splitlines()[2:] if line.strip()]
    closure, pressure = (
        np.array([float(row[k]) for row in rows]) * unit for k, unit in ((1, 1e-3), (2, 1e6))
    )
    turn = int(pressure.argmax())
    down = slice(turn, None)
    return {
        "loading": (pressure[: turn + 1], closure[: turn + 1]),
        "unloading": (pressure[down][::-1], closure[down][::-1]),
    }


def pressed(lower: Path, upper: Path, modulus: float, pressures: np.ndarray) -> np.ndarray:
    """Return the closures of both faces since the first pressure [m]."""
    below, above = rc.read(lower), rc.read(upper)
    found = rc.shift_between(below, above.flipped("x"))
    print(f"the faces fit with {found}")
    gap = rc.combined(below, above, shift=found.vector)
    curve = rc.loading_curve(gap.levelled("plane"), modulus, pressures=pressures)
    return np.asarray(curve.depth - curve.depth[0])


def main() -> None:
    """Run it."""
    parser = argparse.ArgumentParser()
    parser.add_argument("closures", type=Path, nargs="+")
    parser.add_argument("--faces", type=Path, nargs=2)
    chosen = parser.parse_args()
    modulus = YOUNG / (2 * (1 - POISSON**2))
    for path in chosen.closures:
        for branch, (p, closure) in branches(path).items():
            rising = np.concatenate([[True], np.diff(p) > 0])
            data = rc.JointClosures(p[rising], closure[rising], RESOLUTION)
            with np.errstate(divide="ignore"):  # equal closures
                stiffness = np.diff(p[rising]) / np.diff(closure[rising])
            middle = np.sqrt(p[rising][1:] * p[rising][:-1])
            seen = np.isfinite(stiffness) & (stiffness > 0)
            exponent = np.polyfit(np.log(middle[seen]), np.log(stiffness[seen]), 1)[0]
            found = rc.infer_joint(data, modulus=modulus, modulus_error=ERROR, area=AREA, branch=branch)
            print(
                f"{path.name}, {branch}: secants K ~ p^{exponent:.2f}, the model's {found.exponent:.2f}, "
                f"p = {found.p_value:.3f}: {found!r}"
            )
            if chosen.faces and branch == "loading":
                computed = pressed(*chosen.faces, modulus, p[rising])
                for row in zip(p[rising], closure[rising] - closure[rising][0], computed, strict=True):
                    print("{:10.3g} Pa, closure measured {:.3g} m, computed {:.3g} m".format(*row))


if __name__ == "__main__":
    main()
