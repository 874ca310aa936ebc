"""
An elastic block on a half-space
================================

A block of trilinear hexahedra stands on a half-space without friction and is compressed by a rigid plate. The stiffness
of the half-space between the contact nodes, the inverse of ``rc.nodal_flexibility``, is added to that of the block.

The compliance 1/k, less that of the block under a uniform pressure, lies between two limits. Both are bounds by the
principles of energy, and hold on every mesh:

* a stiff block is a rigid punch: 1/(1.1523 E* L), with the side L;
* a soft block exerts a uniform pressure: 0.9464/(E* L), the mean displacement under it.
"""

import matplotlib.pyplot as plt
import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve

import roughcontact as rc

side, poisson_ratio, compression = 20e-3, 0.3, 1e-6  # of the block
modulus = rc.reduced_modulus("aluminium")  # of the half-space only, because the elements contain the block
grid = rc.Grid((32, 32), side / 32)
nodes = np.cumsum([0, 2, 2, 4, 8, 8, 4, 2, 2]) * side / 32  # of the elements, along each edge of the block


def integrals():
    """Return the integrals of products of linear shape functions and their derivatives over a line."""
    lengths = sparse.diags_array(np.diff(nodes))
    left, right = (sparse.eye_array(len(nodes) - 1, len(nodes), k=k) for k in (0, 1))
    mean, step = (left + right) / 2, right - left
    slope = sparse.diags_array(1 / np.diff(nodes)) @ step
    mass = mean.T @ lengths @ mean + step.T @ lengths @ step / 12
    return [[mass, mean.T @ step], [step.T @ mean, slope.T @ step]]


def block(young_modulus):
    """Return the stiffness matrix of the block; displacements are in the order of an array [component, z, y, x]."""
    along = integrals()
    shear = young_modulus / (2 * (1 + poisson_ratio))
    lame = 2 * shear * poisson_ratio / (1 - 2 * poisson_ratio)

    def product(i, j):  # of the derivatives along the axes i and j
        x, y, z = (along[axis == i][axis == j] for axis in range(3))
        return sparse.kron(z, sparse.kron(y, x))

    laplacian = sum(product(i, i) for i in range(3))
    rows = [
        [lame * product(i, j) + shear * product(j, i) + shear * (i == j) * laplacian for j in range(3)]
        for i in range(3)
    ]
    return sparse.block_array(rows, format="csr")


def compressed(stiffness, young_modulus):
    """Return the forces on the contact nodes of a block that is glued to a body of this `stiffness`."""
    numbers = np.arange(3 * nodes.size**3).reshape(3, *3 * nodes.shape)
    bottom, top, middle = numbers[2, 0].ravel(), numbers[2, -1].ravel(), nodes.size // 2
    of_body = sparse.coo_array(
        (stiffness.ravel(), (np.repeat(bottom, len(bottom)), np.tile(bottom, len(bottom)))),
        shape=(numbers.size, numbers.size),
    )
    matrix = (block(young_modulus) + of_body).tocsr()
    # The plate holds the top; planes of symmetry hold the rest.
    held = np.concatenate([top, numbers[0, :, :, middle].ravel(), numbers[1, :, middle].ravel()])
    free = np.setdiff1d(numbers, held)
    displacement = np.zeros(numbers.size)
    displacement[top] = -compression
    displacement[free] = spsolve(matrix[free][:, free].tocsc(), -(matrix @ displacement)[free])
    return -stiffness @ displacement[bottom]


# Linear interpolation from the nodes of an edge to the centres of cells; of both edges, in the order [y, x].
line = np.array([np.interp(grid.coordinates[0], nodes, unit) for unit in np.eye(nodes.size)]).T
interpolation = sparse.csr_array(sparse.kron(line, line))
flexibility = rc.nodal_flexibility(rc.half_space(grid, modulus), interpolation)
stiffness = np.linalg.inv(flexibility)
mass = grid.cell_area * (interpolation.T @ interpolation).toarray()

ratios = np.geomspace(1e-2, 1e2, 9)  # of Young's modulus of the block to E*
forces = np.array([compressed(stiffness, ratio * modulus) for ratio in ratios])
compliances = compression / forces.sum(axis=1)
added = modulus * side * (compliances - 1 / (ratios * modulus * side))
uniform = interpolation.sum(axis=0) * grid.cell_area / side**2  # nodal forces of a uniform pressure
rigid_limit, soft_limit = modulus * side / stiffness.sum(), modulus * side * uniform @ flexibility @ uniform
pressures = (interpolation @ np.linalg.solve(mass, forces.T)).T.reshape(-1, *grid.shape)

left, right = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")[1]
left.semilogx(ratios, added, "o-")
for limit, style, label in (soft_limit, "k--", "uniform pressure"), (rigid_limit, "k:", "rigid punch"):
    left.plot(ratios[[0, -1]], [limit, limit], style, label=label)
left.set(xlabel="modulus of the block / E*", ylabel="E* L (1/k - 1/k of the block)")
left.legend()
for k in (0, 4, 8):
    profile = pressures[k, 16] * side**2 / forces[k].sum()
    right.plot(grid.coordinates[1] * 1e3, profile, label=f"{ratios[k]:g} E*")
right.set(
    xlabel="x [mm]", ylabel="pressure / mean pressure", ylim=(0, None), title="below the middle of the block"
)
right.legend()

print("E* L (1/k - 1/k of the block):", added.round(4))
print(f"between {rigid_limit:.4f} (exact 0.8678) and {soft_limit:.4f} (exact 0.9464)")
print(f"smallest pressure: {pressures.min() / 1e6:.3f} MPa, so that the block lifts off nowhere")
assert np.all(np.diff(added) < 0)
assert rigid_limit < added[-1] < added[0] < soft_limit
assert pressures.min() > 0
