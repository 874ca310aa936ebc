"""What CalculiX does with tables of an interface: the limits that `--table calculix` respects.

    python benchmarks/calculix.py

Two steel blocks (tests/two_blocks.py) are pressed and heated through an interface whose law is known. One line is
printed for each variation. It needs ``ccx`` in PATH.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from two_blocks import CONDUCTIVITY, HEIGHT, HOT, PROGRAM, Blocks, solve

LOW, HIGH = 1e7, 3e8  # Pa: the pressures of the first and the last load
DECAY = 7e-8  # m: p = LOW exp(closing/DECAY - 1)
NODE, SURFACE = "NODE TO SURFACE", "SURFACE TO SURFACE"


def interaction(loads: int, *, law: str = "table", heated: bool = False, form: str = ".13e") -> str:
    """Return an interaction in SI with a number of loads."""
    pressure = np.geomspace(LOW, HIGH, loads)
    closing = DECAY * (1 + np.log(pressure / LOW))
    lines = ["*SURFACE INTERACTION, NAME=ROUGH"]
    if law == "table":
        pairs = [(0.0, 0.0), *zip(pressure, closing, strict=True)]
        lines += ["*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR"]
        lines += [f"{p:{form}}, {u:{form}}" for p, u in pairs]
    else:
        lines += [
            "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL",
            f"{DECAY * np.log(100):.13e}, {LOW / np.e:.13e}",
        ]
    if heated:
        lines += [
            "*GAP CONDUCTANCE",
            "0., 0.",
            *(f"{h:.13e}, {p:.13e}" for h, p in zip(heat(pressure), pressure, strict=True)),
        ]
    return "\n".join(lines)


def heat(pressure: np.ndarray) -> np.ndarray:
    """Return the conductance per area [W/(m^2 K)]."""
    return 3e5 * (pressure / 1e8) ** 0.95


def shown(words: str, pressure: float, loads: int, kind: str, folder: Path, **how: object) -> None:
    """Print the errors of the closing and of the drop of temperature at a pressure."""
    heated, law = bool(how.get("heated")), how.get("law", "table")
    answer = solve(Blocks(interaction(loads, **how), "ROUGH", kind, [(pressure, 0.0)], heated=heated), folder)
    if not answer.joints:
        last = answer.messages[-1] if answer.messages else ""
        print(f"{words:75} no equilibrium: {last.split(':')[-1].strip()[:20] or answer.status}")
        return
    every = np.append(0, np.geomspace(LOW, HIGH, loads))
    straight = np.interp(pressure, every, np.append(0, DECAY * (1 + np.log(every[1:] / LOW))))
    closing = straight if law == "table" else DECAY * (1 + np.log(pressure / LOW))
    text = f"closing {answer.joints[0].closing / closing - 1:+.1e}"
    if heated:
        resistance = 1 / np.interp(pressure, every, np.append(0, heat(every[1:])))
        drop = HOT * resistance / (2 * HEIGHT / CONDUCTIVITY + resistance)
        text += f", drop of temperature {answer.joints[0].drop / drop - 1:+.1e}"
    print(f"{words:75} {text}")


def main() -> None:
    """Print the table."""
    if PROGRAM is None:
        sys.exit("CalculiX is not installed: there is no ccx in PATH")
    between = 1.3 * LOW
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        shown("table, node to surface, 10 loads", between, 10, NODE, folder)
        shown("table, surface to surface, 10 loads", between, 10, SURFACE, folder)
        shown("exponential, surface to surface", between, 10, SURFACE, folder, law="exponential")
        shown(
            "exponential, surface to surface, below the pressure in touch",
            LOW / 4,
            10,
            SURFACE,
            folder,
            law="exponential",
        )
        shown("table, node to surface, 1.1 times the last pressure", 1.1 * HIGH, 10, NODE, folder)
        shown("table, node to surface, numbers of 22 characters", between, 10, NODE, folder, form=".16e")
        shown("table, node to surface, with heat, 10 loads", between, 10, NODE, folder, heated=True)
        for loads in (19, 24, 39):
            shown(
                f"exponential, surface to surface, with heat, {loads} loads",
                between,
                loads,
                SURFACE,
                folder,
                law="exponential",
                heated=True,
            )


if __name__ == "__main__":
    main()
