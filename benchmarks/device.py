"""The table's rows with the heights on another device, and batches of small surfaces there.

    python benchmarks/device.py --device cuda --sizes 512,1024,2048 --cases fractal,flat,sphere

Needs PyTorch. Seconds of one load from heights that already lie where they are pressed, on the host and on the device
in turn, medians of the rounds; no time is shown where the pressures differ by more than 1e-7 of the largest. The
bandwidth is that of adding two long arrays. What is reached of it: the bytes that convolutions, those of
preconditioners included, have to move at least, over what the memory could have moved meanwhile; passes over fields are
left out. Without a GPU, `--device cpu` shows that the script runs, and nothing else.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, nullcontext
from typing import Any

import numpy as np
import torch
from cases import CASES, Problem, chosen
from measure import AGREEMENT
from pairs import without

import roughcontact as rc
from roughcontact.convolution import Convolution

LONG = 2**26  # entries of an array that no cache holds
SMALL, FORCE = 128, 0.046 * 0.01  # of a batch: cells a side, force on the fractal [N]


def finished() -> None:
    """Wait for the device."""
    if torch.cuda.is_available():
        torch.cuda.synchronize()


def seconds(work: Callable[[], Any]) -> float:
    """Return how long some work takes until the device has done it [s]."""
    finished()
    start = time.perf_counter()
    work()
    finished()
    return time.perf_counter() - start


def best(work: Callable[[], Any], rounds: int = 10) -> float:
    """Return the least of some times, after one that is not counted [s]."""
    work()
    return min(seconds(work) for _ in range(rounds))


def bandwidth(device: str) -> float:
    """Return the bytes a second that the memory of a device moves."""
    a, b = (torch.ones(LONG, dtype=torch.float64, device=device) for _ in range(2))
    answer = torch.empty_like(a)
    return 3 * 8 * LONG / best(lambda: torch.add(a, b, out=answer))


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
def counted(convolution: type) -> Iterator[list[int]]:
    """Collect what all convolutions move at least meanwhile [bytes]."""
    moved: list[int] = []
    apply = convolution.apply

    def noted(self: Any, field: Any) -> Any:
        moved.append(least_bytes(field, self.lengths))
        return apply(self, field)

    with without(convolution, "apply", noted):
        yield moved


def surface(problem: Problem, place: Callable[[np.ndarray], Any]) -> rc.Surface:
    """Return the surface of a case, its heights where they are to be pressed."""
    grid = rc.Grid(problem.heights.shape, problem.spacing, periodic=problem.periodic)
    return rc.Surface(place(problem.heights), grid)


def row(name: str, n: int, seed: int, device: str, rounds: int, moved: float) -> str:
    """Return the numbers of one case; `moved` is the bandwidth [bytes/s]."""
    problem = CASES[name](n, seed)
    places = (np.copy, lambda heights: torch.asarray(heights.copy(), device=device))
    here, there = (surface(problem, place) for place in places)

    def load(pressed: rc.Surface) -> rc.Solution:
        return rc.press(pressed, problem.modulus, force=problem.force)

    expected = load(here)
    with counted(Convolution) as bytes_of_load:
        found = load(there)
    difference = np.abs(found.on_host().pressure - expected.pressure).max() / expected.pressure.max()
    if not difference <= AGREEMENT:
        return f"answers differ by {difference:.1e} of the largest pressure"
    pairs = [(seconds(lambda: load(here)), seconds(lambda: load(there))) for _ in range(rounds)]
    host, other = (statistics.median(times) for times in zip(*pairs, strict=True))
    operator, pressure = found.problem.operator, found.pressure
    with counted(Convolution) as bytes_of_product:
        operator.apply(pressure)
    product = best(lambda: operator.apply(pressure))
    return (
        f"{host:.3f} | {other:.3f} | {host / other:.2f} | {found.steps} | {sum(bytes_of_load) / moved / other:.3f} | "
        f"{1e3 * product:.2f} | {sum(bytes_of_product) / moved / product:.2f}"
    )


def batch(device: str, count: int, workers: int) -> float:
    """Return how many small surfaces a second are pressed, so many at a time, each on a stream of its own."""
    grid = rc.Grid((SMALL, SMALL), 1 / SMALL)
    rough = [rc.self_affine(grid, 0.8, 0.01, np.random.default_rng(seed)) for seed in range(count)]
    there = [rc.Surface(torch.asarray(s.heights.copy(), device=device), grid) for s in rough]
    finished()

    def load(pressed: rc.Surface) -> float:
        on_gpu = torch.device(device).type == "cuda"
        with torch.cuda.stream(torch.cuda.Stream(device)) if on_gpu else nullcontext():
            return rc.press(pressed, 1.0, force=FORCE).depth

    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(load, there[:workers]))
        return count / seconds(lambda: list(pool.map(load, there)))


def main() -> None:
    args = _arguments()
    moved = bandwidth(args.device)
    name = torch.cuda.get_device_name(args.device) if args.device.startswith("cuda") else "the host"
    print(f"{name}, PyTorch {torch.__version__}, {moved / 1e9:.0f} GB/s\n")
    print(
        "| case | n | host [s] | device [s] | ratio | products | of the bandwidth | a product [ms] | of it |"
    )
    print("|---" * 9 + "|")
    for case in chosen(args.cases):
        for n in args.sizes:
            line = row(case, n, args.seed, args.device, args.rounds, moved)
            print(f"| {case} | {n} | {line} |", flush=True)
    print(f"\n| {args.batch} surfaces of {SMALL}^2, so many at a time | a second |\n|---|---|")
    for workers in (1, 2, 4, 8, 16):
        print(f"| {workers} | {batch(args.device, args.batch, workers):.0f} |", flush=True)


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--device", default="cuda", help="in PyTorch's words (default: cuda)")
    parser.add_argument(
        "--sizes", type=lambda text: [int(n) for n in text.split(",")], default=[512, 1024, 2048]
    )
    parser.add_argument("--cases", default="fractal,flat,sphere", help="first letters")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--batch", type=int, default=64, help="surfaces of a batch")
    args = parser.parse_args()
    if args.device.startswith("cuda") and not torch.cuda.is_available():
        parser.error("PyTorch finds no GPU here; --device cpu runs the script without one")
    return args


if __name__ == "__main__":
    main()
