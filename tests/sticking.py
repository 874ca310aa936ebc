"""Rough surfaces that stick strongly, and a slow solver that shares nothing with the library's."""

from collections import Counter
from contextlib import contextmanager
from unittest import mock

import numpy as np
import scipy.linalg

import roughcontact as rc
from roughcontact.adhesion import quasi_static


def rough(cells, *, periodic, slope, seed):
    """Return a surface of cells of size 1 with waves from the whole length down to eight cells."""
    rng = np.random.default_rng(seed)
    waves = 2 * np.pi * np.fft.fftfreq(cells)
    q = np.hypot(waves[:, None], waves)
    longest = 8 * np.pi / cells
    gain = np.where((q > 0) & (q < np.pi / 4), np.maximum(q, longest) ** -1.8, 0.0)
    heights = np.fft.ifft2(gain * np.fft.fft2(rng.standard_normal((cells, cells)))).real
    steepness = np.sqrt(sum((g**2).mean() for g in np.gradient(heights)))
    return rc.Surface(heights * slope / steepness, rc.Grid((cells, cells), 1.0, periodic))


def sticky(length, *, reach=0.3):
    """Return an adhesion whose Irwin length on a body of modulus 1 is so many cells."""
    return rc.Adhesion(work=reach**2 / (np.pi * length), range=reach)


def strong(cells):
    """Return a periodic surface of rms slope 0.1 with waves of a half to an eighth of its side, and its adhesion."""
    grid = rc.Grid((cells, cells), 1.0, True)
    rms = {"long_cutoff": cells / 2, "short_cutoff": cells / 8}
    heights = rc.self_affine(grid, 0.8, 1.0, 0, **rms).heights
    waves = 2 * np.pi * np.fft.fftfreq(cells)
    power = np.abs(np.fft.fft2(heights) / heights.size) ** 2
    slope = np.sqrt((power * (waves[:, None] ** 2 + waves**2)).sum())
    return rc.Surface(0.1 / slope * heights, grid), rc.Adhesion(work=0.2, range=1.0)


@contextmanager
def counted():
    """Count the steps of paths, the Newton solves, tests of convexity and flows in them, and the products of each."""
    counts = Counter()

    def counting(name, counter, outcome):
        function = getattr(quasi_static, name)

        def call(*given, **named):
            before = given[counter].products
            answer = function(*given, **named)
            key = outcome(answer, named)
            counts[key] += 1
            counts[f"{key}: products"] += given[counter].products - before
            return answer

        return mock.patch.object(quasi_static, name, call)

    accept, reject = quasi_static._StepControl.accept, quasi_static._StepControl.reject

    def step(name, function):
        def call(self, *given, **named):
            counts[name] += 1
            return function(self, *given, **named)

        return mock.patch.object(quasi_static._StepControl, function.__name__, call)

    with (
        counting(
            "minimise", 2, lambda end, _: "Newton solves" if end.converged else "Newton solves given up"
        ),
        counting(
            "smallest_ratio", 3, lambda ritz, _: "boxes convex" if ritz.positive else "boxes not convex"
        ),
        counting("flow", 3, lambda _, named: "uniform flows" if named.get("uniform") else "flows"),
        step("steps accepted", accept),
        step("steps rejected", reject),
    ):
        yield counts


def slow_path(operator, separation, adhesion, depths):
    """Return the displacement at each depth of a free body, by steps that cannot leave a basin.

    The attraction is taken at the last gap, and what is left is a convex contact problem, solved by matrices. The
    inverse of the influence matrix being one of type M, such steps rise (the wall receding) or fall (approaching)
    monotonically to the nearest equilibrium on that side, whatever the steps of the depth.
    """
    stiffness = np.linalg.inv(operator.as_matrix())
    f = separation.ravel()
    gap = np.maximum(f - depths[0], 0.0) + 1.0
    answers = []
    for depth in depths:
        for _ in range(100_000):
            pull = adhesion.work / adhesion.range * np.exp(-gap / adhesion.range)
            new = contact(stiffness, f - depth, pull, gap)
            moved = np.abs(new - gap).max()
            gap = new
            if moved <= 1e-13:
                break
        answers.append(gap.copy())
    return answers


def contact(stiffness, rest, pull, gap):
    """Minimise ``1/2 (g - rest).K (g - rest) + pull.g`` over g >= 0 by changing the set of closed cells."""
    closed = gap <= 0
    for _ in range(1000):
        free = ~closed
        g = np.zeros(len(rest))
        load = stiffness @ rest - pull
        g[free] = np.linalg.solve(stiffness[np.ix_(free, free)], load[free])
        reaction = stiffness @ g - load
        new = (free & (g < 0)) | (closed & (reaction > 0))
        if (new == closed).all():
            return g
        closed = new
    raise AssertionError("the set of closed cells goes in circles")


def eigenvalues_by_matrices(form, free, curvature):
    """Return the eigenvalues of the pencil from the smallest up, by matrices."""
    units = np.eye(free.size)[free.ravel()].reshape(-1, *free.shape)
    matrix = np.array([form.stiffness(unit)[free] for unit in units]).T
    areas = np.broadcast_to(form.weights, free.shape).ravel()[free.ravel()]
    elastic = areas[:, None] * matrix
    adhesive = np.diag(areas * curvature.ravel()[free.ravel()])
    if form.mean_free:
        inner = scipy.linalg.null_space(np.ones((1, free.sum())))
        elastic, adhesive = inner.T @ elastic @ inner, inner.T @ adhesive @ inner
    elastic = (elastic + elastic.T) / 2
    return scipy.linalg.eigh(elastic - adhesive, elastic, eigvals_only=True)
