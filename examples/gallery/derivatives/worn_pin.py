"""
Inverse problem: edge radius and tilt of a worn pin from its loading curve
==========================================================================

A pin has a flat of known radius with a rounded edge. It is pressed on a flat body, tilted by an unknown angle,
and the zero of the depth gauge is unknown too. Gauss-Newton steps with the exact derivatives of `sensitivity` find
edge radius, tilt and zero from measured depths.

* Pass the change of each height per unit of a parameter to `along`: s²/(2 R²) for the edge radius R, at the distance
  s from the flat, and x for the tilt. The derivative with respect to the zero is 1.
* The highest cells of a flat pin tie, so the depth from first touch has no derivative. With ``reference="level"`` the
  depth counts from the zero of the heights: it is ``solution.depth`` minus the greatest height.
* With the noise σ of the depth, the derivatives J give the Fisher matrix J^T J/σ². The diagonal of its inverse
  holds the squared errors of the parameters.
* Tilts of both signs have the same curve. Do not start at zero tilt, where the derivative vanishes.
* The contact grows by whole cells, which changes the derivatives in steps of 2 to 4 %. The depth is continuous, and
  the noise, 1e-3 of its range, exceeds the error of this grid.
* To first order, a tilt of a sphere is a shift. It changes the depth by the same amount at all loads, and so does
  the zero of the gauge. Therefore the Fisher matrix is singular, and the curve does not determine the tilt.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

modulus, flat, rim = 115e9, 0.4e-3, 0.6e-3  # E* of steel on steel [Pa], radii of the flat and of the pin [m]
forces = np.geomspace(3, 300, 12)  # [N]
names, units, symbols = ("radius", "tilt", "zero"), np.array([1e-3, 1e-3, 1e-6]), ("mm", "mrad", "µm")
pin = np.array([5, 1, 0.3])  # the true parameters, in these units
# This tilt shifts the sphere by 2.5 cells, so its contact stays symmetric. Shifts by other parts of a cell change the
# contact in steps, which give the tilt an error larger than the tilt: 1.4 mrad at 0.73 mrad.
sphere = np.array([50, 1, 0.3])


def shape(parameters, flat, x, y):
    """Return the heights [m] and their derivatives; a flat of radius 0 makes a sphere."""
    radius, tilt, _ = parameters * units
    s = np.maximum(np.hypot(x, y) - flat, 0)
    return tilt * x - s**2 / (2 * radius), (s**2 / (2 * radius**2), x)


def predicted(parameters, flat, cells=60):
    """Return the depths [µm] and their derivatives."""
    grid = rc.Grid((cells, cells), 2 * rim / cells)
    y, x = np.meshgrid(*(each - each.mean() for each in grid.coordinates), indexing="ij")
    heights, directions = shape(parameters, flat, x, y)
    surface = rc.Surface(np.where(np.hypot(x, y) < rim, heights, np.nan), grid)
    zero = parameters[2] * units[2] - np.nanmax(surface.heights)
    depths, rows = [], []
    for solution in rc.loading_path(surface, modulus, forces=forces):
        derivatives = rc.sensitivity(solution, reference="level")
        depths.append(solution.depth + zero)
        rows.append([*(derivatives.along(each)["depth_at_force"] for each in directions), 1])
    return np.array(depths) / 1e-6, np.array(rows) * units / 1e-6


def errors(derivatives, noise):
    """Return the errors by the Fisher matrix, also of a singular one: what the other columns do not explain counts."""
    left = []
    for k, column in enumerate(derivatives.T):
        others = np.delete(derivatives, k, axis=1)
        left.append(np.linalg.norm(column - others @ np.linalg.lstsq(others, column)[0]))
    return noise / np.array(left)


def report(body, parameters, derivatives, noise):
    eigenvalues = np.linalg.eigvalsh(derivatives.T @ derivatives) / noise**2
    singular = eigenvalues[0] < 1e-12 * eigenvalues[-1]  # rounding
    print(f"{body}: the Fisher matrix is {'singular' if singular else 'regular'}")
    for name, value, error, unit in zip(names, parameters, errors(derivatives, noise), symbols, strict=True):
        known = f"({value:.3f} ± {error:.3f}) {unit}" if error < value else "these loads do not determine it"
        print(f"  {name}: {known}")
    return singular


# The measurement: computed on a grid twice as fine, with noise.
fine = predicted(pin, flat, cells=120)[0]
noise = 1e-3 * np.ptp(fine)
measured = fine + noise * np.random.default_rng(1).normal(size=fine.size)

start = np.array([2, 0.5, 0])
parameters = start
for count in range(1, 7):
    depths, derivatives = predicted(parameters, flat)
    rms = np.sqrt(np.mean((measured - depths) ** 2)) * 1e3
    print(f"curve {count}: {parameters[0]:.3f} mm, {parameters[1]:.3f} mrad, rms misfit {rms:.1f} nm")
    parameters = parameters + np.linalg.lstsq(derivatives, measured - depths)[0]
depths, derivatives = predicted(parameters, flat)
of_sphere = predicted(sphere, 0)[1]
singular = [
    report("pin", parameters, derivatives, noise),
    report("sphere", sphere, of_sphere, noise),
]
print("A tilt shifts the sphere, so these loads cannot separate its tilt from the zero of the gauge.")

profile, law, effects = plt.subplots(1, 3, figsize=(11, 3.6), layout="constrained")[1]
x = np.linspace(-rim, rim, 201)
for each, style, label in (start, "C1--", "start"), (parameters, "C0-", "found"), (pin, "k:", "true"):
    profile.plot(x * 1e3, shape(each, flat, x, 0)[0] * 1e6, style, label=label)
profile.set(xlabel="x [mm]", ylabel="height [µm]", title="section of the pin")
profile.legend()
law.plot(predicted(start, flat)[0], forces, "C1--", label="start")
law.plot(depths, forces, "C0-", label="found")
law.plot(measured, forces, "C3.", label="measured")
law.set(xlabel="reading of the gauge [µm]", ylabel="force [N]", title="loading")
law.legend()
effects.semilogx(forces, derivatives[:, 1], "o-", label="pin")
effects.semilogx(forces, of_sphere[:, 1], "s-", label="sphere")
effects.set(
    xlabel="force [N]", ylabel="change of depth [µm per mrad]", title="derivative with respect to the tilt"
)
effects.legend()

deviation = np.abs(parameters - pin) / errors(derivatives, noise)
grid_error = np.max(np.abs(predicted(pin, flat)[0] - fine)) / noise
print(f"error of the depth by the grid, in units of the noise: {grid_error:.2f}")
print("deviations from the true values, in errors:", deviation.round(1))
assert singular == [False, True]
assert grid_error < 1
assert np.all(deviation < 4)  # three normal variables exceed it once in 5000 cases
