"""
Design a joint of constant stiffness
====================================

The stiffness of a rough joint grows with the load. This example changes the 64 x 64 heights of a periodic cell
until the force grows linearly with the depth. `differentiable_curve` returns the depths at given forces and the
exact gradient of their misfit, which L-BFGS-B needs. Forward differences took 4097 curves for one such gradient,
which agreed to 5e-4 of its largest entry. The summits become plateaus.

* With ``reference="level"`` the depth counts from the zero of the heights, here the mean plane. First touch would
  move with a single cell.
* The change of the heights and the gradient pass through the same symmetric filter, which suppresses waves that
  the grid cannot resolve, and lose their means. Therefore the mean height stays the same.
* Only cells in contact have a gradient. Valleys change through the filter and through the mean.
* The gradient changes in a step when a cell comes into contact. Check it with central differences over a step in
  which the contact does not change, here a millionth of a micrometre.
"""

import time

import matplotlib.pyplot as plt
import numpy as np
from scipy.ndimage import gaussian_filter, zoom
from scipy.optimize import minimize

import roughcontact as rc

modulus, grid = 1e9, rc.Grid((64, 64), 4e-6, periodic=True)  # E* of a polymer [Pa]
rough = rc.self_affine(grid, hurst=0.8, rms=1e-6, rolloff=128e-6, short_cutoff=32e-6, rng=2)
pressures = np.linspace(1e6, 8e6, 8)
curve = rc.differentiable_curve(grid, modulus, pressures=pressures, reference="level")
before = curve.linearise(rough.heights)[0]
target = np.linspace(before.depth[0], before.depth[-1], 8)  # the forces are equally spaced
unit, misfits = 1e-6, []  # the optimiser works in micrometres


def filtered(field):
    smooth = gaussian_filter(field, sigma=1, mode="wrap")  # in cells
    return smooth - smooth.mean()


def heights(unknowns):
    return rough.heights + unit * filtered(unknowns.reshape(grid.shape))


def misfit(unknowns):
    values, pullback = curve.linearise(heights(unknowns))
    difference = (values.depth - target) / unit
    misfits.append(np.sqrt(np.mean(difference**2)))
    return 0.5 * np.sum(difference**2), filtered(pullback(depth=difference)).ravel()


start, begun = np.zeros(rough.heights.size), time.perf_counter()
found = minimize(misfit, start, jac=True, method="L-BFGS-B", options={"maxiter": 60, "gtol": 1e-7})
seconds = time.perf_counter() - begun
designed = rc.Surface(heights(found.x), grid)
after = curve.linearise(designed.heights)[0]

(left, right), (law, progress) = plt.subplots(2, 2, figsize=(9, 7.4), layout="constrained")[1]
for axes, surface, title in (left, rough, "before"), (right, designed, "after"):
    surface.plot(axes)
    axes.images[0].set_clim(1e6 * rough.heights.min(), 1e6 * rough.heights.max())
    axes.set_title(title)
law.plot(before.depth * 1e6, before.force, "o-", label="before")
law.plot(after.depth * 1e6, after.force, "s-", label="after")
law.plot(target * 1e6, before.force, "k:", label="target")
law.set(xlabel="depth from the mean plane [µm]", ylabel="force on the cell [N]")
law.legend()
progress.semilogy(np.arange(1, len(misfits) + 1), 1e3 * np.array(misfits))
progress.set(xlabel="curves computed", ylabel="rms misfit of the depth [nm]")

print(f"{found.nit} iterations of L-BFGS-B: {found.nfev} curves of 8 loads with gradients, {seconds:.1f} s")
print(f"rms misfit of the depth: {1e3 * misfits[0]:.0f} nm before, {1e3 * min(misfits):.1f} nm after")

stiffness = [np.diff(each.force) / np.diff(each.depth) for each in (before, after)]
ratios = [each[-1] / each[0] for each in stiffness]
print(
    f"stiffness between the last two loads over that between the first two: {ratios[0]:.1f}, then {ratios[1]:.2f}"
)

# The same surface on a grid twice as fine: the edges of the plateaus are one cell wide.
fine = rc.Grid((128, 128), 2e-6, periodic=True)
refined = zoom(designed.heights, 2, mode="grid-wrap", grid_mode=True)
check = rc.differentiable_curve(fine, modulus, pressures=pressures, reference="level").linearise(refined)[0]
print(f"grid twice as fine: rms misfit {1e9 * np.sqrt(np.mean((check.depth - target) ** 2)):.0f} nm")

# A step so small that no cell changes its contact. Each load has the tolerance 1e-8.
step = 1e-6 * np.random.default_rng(3).normal(size=start.size)
central = (misfit(step)[0] - misfit(-step)[0]) / 2
assert np.isclose(misfit(start)[1] @ step, central, rtol=1e-3)
assert min(misfits) < misfits[0] / 20
assert ratios[0] > 5 > 1.2 > ratios[1] > 0.8
assert abs(designed.heights.mean() - rough.heights.mean()) < 1e-9 * unit  # rounding
