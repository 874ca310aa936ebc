"""Two steel blocks, one upon the other, as an input file for CalculiX, and the displacements at their interface.

The state is uniform: a pressure on the upper block, with free sides; or a pressure and a tangential traction, with each
layer of nodes moving without rotation or strain. Both blocks have the size `SIDE` x `SIDE` x `HEIGHT`.
"""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughcontact.evaluation.interface_text import UNIT_SYSTEMS

SIDE, HEIGHT = 1e-3, 5e-4
YOUNG, POISSON, CONDUCTIVITY = 2e11, 0.3, 50.0
HOT = 100.0  # temperature of the upper end; the lower one has 0
PROGRAM = shutil.which("ccx")


@dataclass(frozen=True)
class Blocks:
    """Meshes of the lower and the upper block, loads and contact; `steps` are pressures and tractions [Pa]."""

    interaction: str
    name: str
    kind: str
    steps: Sequence[tuple[float, float]]
    units: str = "SI"
    cells: tuple[tuple[int, int, int], tuple[int, int, int]] = ((3, 3, 2), (3, 3, 2))
    poisson: float = 0.0
    heated: bool = False
    sheared: bool = False

    def text(self) -> str:
        """Return the input file."""
        return "\n".join(self._lines()) + "\n"

    def _lines(self) -> Iterator[str]:
        pascal, metre, *_ = UNIT_SYSTEMS[self.units][1]
        side, height = SIDE * metre, HEIGHT * metre
        layers, elements, nodes, hexahedra = [], [], 0, 0
        for shape, floor, block in zip(self.cells, (0.0, height), ("LOWER", "UPPER"), strict=True):
            nx, ny, nz = shape
            ids = nodes + 1 + np.arange((nx + 1) * (ny + 1) * (nz + 1)).reshape(nz + 1, ny + 1, nx + 1)
            yield "*NODE, NSET=ALL"
            for (z, y, x), node in np.ndenumerate(ids):
                yield f"{node}, {side * x / nx:.12g}, {side * y / ny:.12g}, {floor + height * z / nz:.12g}"
            yield f"*ELEMENT, TYPE=C3D8, ELSET={block}"
            own = hexahedra + 1 + np.arange(nx * ny * nz).reshape(nz, ny, nx)
            for (z, y, x), number in np.ndenumerate(own):
                low, high = ids[z, y : y + 2, x : x + 2], ids[z + 1, y : y + 2, x : x + 2]
                ring = [*low[0], *low[1, ::-1], *high[0], *high[1, ::-1]]
                yield ", ".join(map(str, [number, *ring]))
            nodes, hexahedra = ids.max(), own.max()
            layers.append(ids)
            elements.append(own)
        lower, upper = layers
        sets = {"BASE": lower[0], "HEAD": upper[-1], "LOWFACE": lower[-1], "UPFACE": upper[0]}
        sets |= {"AXIS1": np.append(lower[:, :, 0], upper[:, :, 0])}
        sets |= {"AXIS2": np.append(lower[:, 0], upper[:, 0])}
        for name, members in sets.items():
            yield f"*NSET, NSET={name}"
            yield from map(str, members.ravel())
        for name, members, side_of in (
            ("MASTER", elements[0][-1], "S2"),
            ("SLAVE", elements[1][0], "S1"),
        ):
            yield f"*SURFACE, NAME={name}, TYPE=ELEMENT"
            yield from (f"{number}, {side_of}" for number in members.ravel())
        # W/(m K) is also mW/(mm K).
        yield f"*MATERIAL, NAME=STEEL\n*ELASTIC\n{YOUNG * pascal:.12g}, {self.poisson}\n*CONDUCTIVITY\n{CONDUCTIVITY}"
        yield "*SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL\n*SOLID SECTION, ELSET=UPPER, MATERIAL=STEEL"
        yield self.interaction.rstrip("\n")
        yield f"*CONTACT PAIR, INTERACTION={self.name}, TYPE={self.kind}\nSLAVE, MASTER"
        if self.heated:
            yield "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 0."
        yield from self._supports(layers)
        for pressure, traction in self.steps:
            yield "*STEP, INC=1000"
            yield "*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE" if self.heated else "*STATIC"
            yield "1., 1., 1e-4"
            # More iterations than by default, and residuals of a millionth.
            yield "*CONTROLS, PARAMETERS=TIME INCREMENTATION\n100, 100, 9, 100, 10, 4, , 5"
            yield "*CONTROLS, PARAMETERS=FIELD\n1e-6, 1e-6"
            if self.heated:
                yield f"*BOUNDARY\nBASE, 11, 11, 0.\nHEAD, 11, 11, {HOT}"
            yield "*DLOAD"
            yield from (f"{number}, P2, {pressure * pascal:.12g}" for number in elements[1][-1].ravel())
            if traction:
                yield f"*CLOAD\n{upper[-1, 0, 0]}, 1, {traction * pascal * side**2:.12g}"
            for face in ("LOWFACE", "UPFACE"):
                yield f"*NODE PRINT, NSET={face}\nU" + (", NT" if self.heated else "")
            yield "*END STEP"

    def _supports(self, layers: Sequence[np.ndarray]) -> Iterator[str]:
        if not self.sheared:
            yield "*BOUNDARY\nBASE, 3, 3\nAXIS1, 1, 1\nAXIS2, 2, 2"
            return
        for first, *others in (layer.ravel() for ids in layers for layer in ids):
            for node in others:
                for axis in (1, 3):
                    yield f"*EQUATION\n2\n{node}, {axis}, 1., {first}, {axis}, -1."
        base = layers[0][0, 0, 0]
        yield f"*BOUNDARY\nALL, 2, 2\n{base}, 1, 1\n{base}, 3, 3"


@dataclass(frozen=True)
class Joint:
    """The interface after a step: closing and slip [m], drop of temperature, and the errors of all three."""

    closing: float
    slip: float
    drop: float
    errors: tuple[float, float, float]


@dataclass(frozen=True)
class Answer:
    """What CalculiX printed: its status, its messages, and the interface after each step."""

    status: int
    messages: list[str]
    joints: list[Joint]


def solve(blocks: Blocks, folder: Path) -> Answer:
    """Run CalculiX in a folder."""
    (folder / "job.inp").write_text(blocks.text(), encoding="utf-8")
    words = [PROGRAM, "-i", "job"]
    run = subprocess.run(words, cwd=folder, capture_output=True, encoding="utf-8", timeout=300, check=False)
    lines = [line.strip() for line in run.stdout.splitlines()]
    starts = [k for k, line in enumerate(lines) if line.startswith(("*WARNING", "*ERROR"))]
    messages = [" ".join(lines[k : k + 3]) for k in starts]
    joints = (
        list(_joints(blocks, (folder / "job.dat").read_text(encoding="utf-8"))) if not run.returncode else []
    )
    return Answer(run.returncode, messages, joints)


def _joints(blocks: Blocks, printed: str) -> Iterator[Joint]:
    metre = UNIT_SYSTEMS[blocks.units][1][1]
    blocks_of_lines = re.findall(
        r"^ (\w+) .*set (\w+) and time +(\S+)\n\n((?:.*\d\n)+)", printed, re.MULTILINE
    )
    found = {
        (what, face, float(time)): np.array([line.split()[1:] for line in body.splitlines()], float)
        for what, face, time, body in blocks_of_lines
    }
    for step in range(1, len(blocks.steps) + 1):
        low, high = (found["displacements", face, step] / metre for face in ("LOWFACE", "UPFACE"))
        heat = [found.get(("temperatures", face, step), np.zeros((1, 1))) for face in ("LOWFACE", "UPFACE")]
        # Seven digits are printed: half a unit of the last one is at most 5e-7 of the number. CalculiX also ends where
        # the last correction is at most 1e-6 of the largest increment, that of the upper end: at most twice that of the
        # upper face, since both blocks are equally high.
        shift, _, closing = low.mean(axis=0) - high.mean(axis=0)
        size = 5e-7 * (abs(low).max(axis=0) + abs(high).max(axis=0)) + 2e-6 * abs(high).max()
        warmth = 5e-7 * (abs(heat[0]).max() + abs(heat[1]).max()) + 1e-6 * HOT
        yield Joint(closing, -shift, heat[1].mean() - heat[0].mean(), (size[2], size[0], warmth))
