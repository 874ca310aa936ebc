"""Which loads a map resolves: the ends of the range for self-affine surfaces, over E* h/L.

    python benchmarks/resolved.py

Free and periodic squares of 32 to 256 points a side, four surfaces of each; see docs/how-to/studies.md.
"""

from __future__ import annotations

import tempfile

import numpy as np

import roughcontact as rc

POINTS, HURST, SAMPLES = (32, 64, 128, 256), (0.2, 0.5, 0.8, 1.0), 4


def main() -> None:
    """Print a line for each number of points: the largest of the lower ends and the smallest of the upper ones."""
    for periodic in (False, True):
        fixed = {"size": "1 mm", "rms": "1 um", "modulus": "100 GPa", "periodic": periodic}
        forces = {"lowest_force": 1e-3, "highest_force": 20.0, "loads": 61}
        table = {"points": POINTS, "hurst": HURST}
        study = rc.study.Study(
            name="resolved", case="curve", samples=SAMPLES, parameters=fixed | forces, table=table
        )
        with tempfile.TemporaryDirectory() as folder:
            rc.study.run(study, folder, rc.study.Processes(2))
            with rc.study.Store.open(folder) as store:
                averaged = rc.statistics.averages(rc.study.export(store), rng=np.random.default_rng(1))
        force = averaged["dimensionless_force"].to_numpy()
        print("periodic" if periodic else "free")
        for points in POINTS:
            counts = averaged["resolved_samples"].sel(points=points).to_numpy()
            ends = [[force[row >= least][[0, -1]] for row in counts] for least in (SAMPLES, SAMPLES // 2)]
            words = [f"{np.max(each, 0)[0]:8.3f} to {np.min(each, 0)[1]:6.2f}" for each in ends]
            print(f"{points:5d}   all samples {words[0]}   half of them {words[1]}")


if __name__ == "__main__":
    main()
