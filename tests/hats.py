"""The thesis' axisymmetric matrix with hat functions (A.26 to A.36 as corrected): an independent truth for rings."""

import numpy as np
from scipy.special import ellipkm1


def u0(r, a):
    """Displacement of a ring of unit weight, a S(r, a) = 4/(1 + r/a) K(2 sqrt(r/a)/(1 + r/a)) (A.26 corrected)."""
    return 4 * a / (a + r) * ellipkm1(((a - r) / (a + r)) ** 2)


def hat_matrix(count, first=0):
    """Return B, shape (N + 1, N + 1): row of the field node, column of the hat, in units of the step.

    ``u_j = D/(pi E*) sum_i B[j, i] p_i``. Each hat is two half-cells. Those that do not touch the field node take
    Gauss's rule; those that do have a logarithm there, which ``a = j +- t^6`` takes away. About
    a hole of radius `first` the innermost hat is a half one, as the outermost is.
    """
    far, near = (np.polynomial.legendre.leggauss(n) for n in (12, 20))
    nodes, weights = (far[0] + 1) / 2, far[1] / 2
    t, wt = (near[0] + 1) / 2, near[1] / 2
    matrix = np.zeros((count + 1, count + 1))
    for j in range(count + 1):
        for cell in range(first, count):  # between the nodes cell and cell + 1
            if j == 0:
                values, rise = np.full(nodes.shape, 2 * np.pi), nodes
                w = weights
            elif cell in (j - 1, j):
                side = 1 if cell == j else -1
                offset, w = t**6, wt * 6 * t**5
                a = j + side * offset
                # (a - j)/(a + j) without cancellation
                values = 4 * a / (a + j) * ellipkm1((offset / (2 * j + side * offset)) ** 2)
                rise = offset if side > 0 else 1 - offset
            else:
                a, w = cell + nodes, weights
                values, rise = u0(float(j), a), nodes
            matrix[j, cell] += w @ (values * (1 - rise))
            matrix[j, cell + 1] += w @ (values * rise)
    return matrix


def hat_weights(count, first=0):
    """Return w with force = D^2 sum w_i p_i: the volumes of the hats."""
    weights = 2 * np.pi * np.arange(count + 1.0)
    weights[:first] = 0
    weights[first], weights[-1] = np.pi * (first + 1 / 3), np.pi * (count - 1 / 3)
    return weights


def press(profile, count, depth):
    """Return nodes, pressure and force of a body of revolution on [0, 1] at a given depth, E* = 1, by active set."""
    step = 1.0 / count
    matrix = step / np.pi * hat_matrix(count)
    r = np.arange(count + 1) * step
    wanted = depth - profile(r)
    active = wanted > 0
    for _ in range(50):
        p = np.zeros(count + 1)
        p[active] = np.linalg.solve(matrix[np.ix_(active, active)], wanted[active])
        gap = matrix @ p - wanted
        following = (active & (p > 0)) | (~active & (gap < 0))
        if (following == active).all():
            return r, p, step**2 * hat_weights(count) @ p
        active = following
    raise AssertionError
