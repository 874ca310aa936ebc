"""The table's rows with the heights on another device, and batches of small surfaces there.

    python benchmarks/device.py --device cuda --sizes 512,1024,2048 --cases fractal,flat,sphere

Needs PyTorch. Seconds of one load from heights that already lie where they are pressed, on the host and on the device
in turn, medians of the rounds; no time is shown where the answers differ by more than 1e-7 of the largest pressure,
certified to 1e-10 if need be, or of the depth. "Faster" is the host's time over the device's. "Bandwidth" is what
convolutions there, those of preconditioners included, have to move at least, over what the memory could have moved
meanwhile, as it does where two long arrays are added; passes over fields are left out, and coarse levels, which are
solved on the host. What stays in the device's cache, as planes of 512 x 512 cells do in large ones,
is not moved at all: a product alone may reach more than 1. Without a GPU, `--device cpu` shows that the script runs,
and nothing else.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any

import numpy as np
from pairs import without
from suite.cases import CASES, Problem, chosen
from suite.measure import AGREEMENT, TIGHT

import roughcontact as rc
from roughcontact.transforms import Convolution

try:
    import torch
except ImportError:
    sys.exit("benchmarks/device.py needs PyTorch: see https://pytorch.org for the build for your GPU")

LONG = 2**26  # entries of an array that no cache holds
SMALL, FORCE = 128, 0.046 * 0.01  # of a batch: cells a side, force on the fractal [N]
WORKERS = (1, 2, 4, 8, 16)  # loads at a time


def finish(device: torch.device) -> None:
    """Wait until a device has done all that it was told."""
    if device.type == "cuda":
        torch.cuda.synchronize(device)


def seconds(work: Callable[[], Any], device: torch.device) -> float:
    """Return how long some work takes until the device has done it [s]."""
    finish(device)
    start = time.perf_counter()
    work()
    finish(device)
    return time.perf_counter() - start


def best(work: Callable[[], Any], device: torch.device, rounds: int = 10) -> float:
    """Return the least of some times, after one that is not counted [s]."""
    work()
    return min(seconds(work, device) for _ in range(rounds))


def bandwidth(device: torch.device) -> float:
    """Return the bytes a second that the memory of a device moves."""
    a, b = (torch.ones(LONG, dtype=torch.float64, device=device) for _ in range(2))
    answer = torch.empty_like(a)
    return 3 * 8 * LONG / best(lambda: torch.add(a, b, out=answer), device)


def least_bytes(field: Any, lengths: tuple[int, int]) -> int:
    """Return what a convolution moves at least, if each transform reads and writes its values once.

    Rows to half spectra, columns, their product with a real kernel of a quarter of the padded plane, and back.
    """
    value = field.dtype.itemsize
    half = 2 * value * (lengths[1] // 2 + 1)  # bytes of a row of the spectrum
    along_rows = field.shape[0] * (value * field.shape[1] + half)
    along_columns = (field.shape[0] + lengths[0]) * half
    multiplied = 2 * lengths[0] * half + value * (lengths[0] // 2 + 1) * (lengths[1] // 2 + 1)
    return 2 * (along_rows + along_columns) + multiplied


@contextmanager
def counted() -> Iterator[list[int]]:
    """Collect what all convolutions of PyTorch's arrays move at least meanwhile [bytes]."""
    moved: list[int] = []
    apply = Convolution.apply

    def noted(self: Convolution, field: Any) -> Any:
        if isinstance(field, torch.Tensor):  # coarse levels are the host's
            moved.append(least_bytes(field, self.lengths))
        return apply(self, field)

    with without(Convolution, "apply", noted):
        yield moved


def surface(problem: Problem, device: torch.device | None = None) -> rc.Surface:
    """Return the surface of a case, its heights on a device, or on the host."""
    grid = rc.Grid(problem.heights.shape, problem.spacing, periodic=problem.periodic)
    heights = problem.heights.copy()
    return rc.Surface(heights if device is None else torch.asarray(heights, device=device), grid)


def row(name: str, n: int, seed: int, device: torch.device, rounds: int, speed: float) -> str:
    """Return the numbers of one case; `speed` is the bandwidth [bytes/s]."""
    problem = CASES[name](n, seed)
    here, there = surface(problem), surface(problem, device)

    def load(pressed: rc.Surface, tolerance: float = 1e-8) -> rc.Solution:
        return rc.press(pressed, problem.modulus, force=problem.force, tolerance=tolerance)

    def apart(found: rc.Solution, expected: rc.Solution) -> float:
        return float(np.abs(found.on_host().pressure - expected.pressure).max() / expected.pressure.max())

    try:
        with counted() as bytes_of_load:
            found = load(there)
        difference = apart(found, load(here))
        if not difference <= AGREEMENT:  # see `measure`: both are certified
            difference = apart(load(there, TIGHT), load(here, TIGHT))
    except rc.ConvergenceError as error:
        return f"{error}{' |' * 6}"
    if not difference <= AGREEMENT:
        return f"answers differ by {difference:.1e} of the largest pressure{' |' * 6}"
    pairs = [
        (seconds(lambda: load(here), device), seconds(lambda: load(there), device)) for _ in range(rounds)
    ]
    host, other = (statistics.median(times) for times in zip(*pairs, strict=True))
    operator, pressure = found.problem.operator, found.pressure
    with counted() as bytes_of_product:
        operator.apply(pressure)
    product = best(lambda: operator.apply(pressure), device)
    return (
        f"{host:.3f} | {other:.3f} | {host / other:.2f} | {found.steps} | {sum(bytes_of_load) / speed / other:.3f} | "
        f"{1e3 * product:.2f} | {sum(bytes_of_product) / speed / product:.2f}"
    )


def batch(pressed: list[rc.Surface], depths: list[float], device: torch.device, workers: int) -> str:
    """Return how many surfaces a second are pressed, so many at a time, each thread on a stream of its own."""

    def own_stream() -> None:
        if device.type == "cuda":
            torch.cuda.set_stream(torch.cuda.Stream(device))

    def depth(surface: rc.Surface) -> float:
        return rc.press(surface, 1.0, force=FORCE).depth

    with ThreadPoolExecutor(workers, initializer=own_stream) as pool:
        found = list(pool.map(depth, pressed))  # warms up all threads
        if not np.allclose(found, depths, rtol=AGREEMENT, atol=0.0):
            return "answers differ"
        return f"{len(pressed) / seconds(lambda: list(pool.map(depth, pressed)), device):.0f}"


def main() -> None:
    args = _arguments()
    device = args.device
    speed = bandwidth(device)
    name = torch.cuda.get_device_name(device) if device.type == "cuda" else "the host"
    print(f"{name}, PyTorch {torch.__version__}, {speed / 1e9:.0f} GB/s\n")
    print(
        "| case | n | host [s] | device [s] | faster | products | bandwidth | a product [ms] | its bandwidth |"
    )
    print("|---" * 9 + "|")
    for case in args.cases:
        for n in args.sizes:
            print(f"| {case} | {n} | {row(case, n, args.seed, device, args.rounds, speed)} |", flush=True)
    grid = rc.Grid((SMALL, SMALL), 1 / SMALL)
    rough = [rc.self_affine(grid, 0.8, 0.01, np.random.default_rng(seed)) for seed in range(args.batch)]
    depths = [rc.press(each, 1.0, force=FORCE).depth for each in rough]
    there = [rc.Surface(torch.asarray(each.heights.copy(), device=device), grid) for each in rough]
    print(f"\n| {args.batch} surfaces of {SMALL} x {SMALL}, so many at a time | host, a second | device |")
    print("|---" * 3 + "|")
    for workers in (k for k in WORKERS if k <= args.batch):
        print(
            f"| {workers} | {batch(rough, depths, torch.device('cpu'), workers)} | "
            f"{batch(there, depths, device, workers)} |",
            flush=True,
        )


def _arguments() -> argparse.Namespace:
    def count(text: str) -> int:
        if not text.isdecimal() or int(text) < 1:
            raise argparse.ArgumentTypeError(f"{text!r} is no whole number of at least 1")
        return int(text)

    def counts(text: str) -> list[int]:
        return [count(part) for part in text.split(",")]

    def place(text: str) -> torch.device:
        try:
            device = torch.device(text)
        except RuntimeError:
            device = None
        if device is None or device.type not in ("cuda", "cpu"):
            raise argparse.ArgumentTypeError(f"{text!r} is neither cuda, cuda:1, ... nor cpu")
        if device.type == "cuda" and (device.index or 0) >= torch.cuda.device_count():
            raise argparse.ArgumentTypeError("PyTorch finds no such GPU; --device cpu runs without one")
        return device

    def cases(text: str) -> list[str]:
        try:
            return chosen(text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from error

    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--device", type=place, default="cuda", help="cuda, cuda:1, ... (default: cuda)")
    parser.add_argument("--sizes", type=counts, default="512,1024,2048", help="cells a side")
    parser.add_argument("--cases", type=cases, default="fractal,flat,sphere", help="first letters")
    parser.add_argument("--seed", type=int, default=0, help="of the surfaces (default: 0)")
    parser.add_argument("--rounds", type=count, default=5, help="of host and device in turn (default: 5)")
    parser.add_argument(
        "--batch",
        type=count,
        default=64,
        help=f"surfaces of a batch, of {SMALL} x {SMALL} cells (default: 64)",
    )
    return parser.parse_args()


if __name__ == "__main__":
    main()
