"""
Oil film under a rubber roller: elastohydrodynamic line contact (EHL)
=====================================================================

A soft roller turns on a flat that is covered with oil. The oil that it draws in carries the load: how thick is the
film? Reynolds' equation of a steady flow, d/dx (h³/(12 eta) dp/dx) = U dh/dx with p >= 0, is solved together with the
displacement of the rubber, which is that of ``rc.line``. U is the mean speed of both faces.

The viscosity does not depend on the pressure. This holds for rubber and for other soft bodies (soft EHL). Under the
pressures between steel bodies, the viscosity of oil grows by orders of magnitude, and the film is thicker. The other
limit, a rigid roller, is Martin's film.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

modulus, radius, load = 10e6, 10e-3, 1e3  # E* [Pa], radius [m], load per length [N/m]
viscosity = 0.1  # [Pa s]
speeds = np.geomspace(3, 0.03, 7)  # [m/s]
hertz = rc.theory.hertz.line(modulus, radius=radius, force=load)


def film(speed, width, soft=1.0, start=None, cells=300, inlet=3.5, outlet=1.5):
    """Return the places x, film thickness and pressure, and the state to start the next speed from.

    Lengths count in `width`, thicknesses in width²/radius, pressures in load/width. Newton's method: where the film
    breaks the pressure is zero, elsewhere the flow into each cell balances; the load determines the offset h0.
    """
    unit, grid = width**2 / radius, rc.Grid(cells, (inlet + outlet) / cells)
    x, dx, eye = grid.coordinates[0] - inlet, grid.spacing[0], np.eye(cells)
    body = soft * load * radius / (modulus * width**2) * rc.line(grid, 1.0).as_matrix()
    drawn = 12 * viscosity * speed * width**2 / (unit**2 * load)
    # Mean thickness and slope of the pressure at the edges of the cells: ambient in front, constant behind.
    mean = np.vstack([eye[:1], (eye[1:] + eye[:-1]) / 2, eye[-1:]])
    slope = np.vstack([2 * eye[:1], eye[1:] - eye[:-1], 0 * eye[:1]]) / dx
    p, h0 = start or (np.maximum(1 - x**2, 0) * 0.75, 4.895 / 12 * drawn)
    for _ in range(100):
        h = h0 + x**2 / 2 + body @ p
        face, drop = mean @ h, slope @ p
        flow = drawn * face - face**3 * drop
        by_h = drawn - 3 * face**2 * drop
        by_p = np.diff(by_h[:, None] * (mean @ body) - (face**3)[:, None] * slope, axis=0)
        system = np.block([[by_p, np.diff(by_h)[:, None]], [np.full((1, cells), dx), np.zeros((1, 1))]])
        right = np.append(-np.diff(flow), 1 - p.sum() * dx)
        broken = p <= np.diff(flow) / np.abs(by_p.diagonal()).max()
        system[:-1][broken], right[:-1][broken] = np.eye(cells, cells + 1)[broken], -p[broken]
        step = np.linalg.solve(system, right)
        thinner = -(step[-1] + body @ step[:-1]) / h
        part = min(1.0, 0.5 / max(thinner.max(), 1e-9))  # no film closes in one step
        p, h0 = p + part * step[:-1], h0 + part * step[-1]
        if part == 1 and np.abs(step[:-1]).max() < 1e-10 * p.max():
            return x * width, (h0 + x**2 / 2 + body @ p) * unit, p * load / width, (p, h0)
    raise RuntimeError("Newton's method did not converge")


state, thinnest = None, []
for speed in speeds:
    x, h, p, state = film(speed, hertz.half_width, start=state)
    thinnest.append(h.min())
# Herrebrugh's film, in the numbers of Moes; his speed is the sum of both.
moes = np.sqrt(viscosity * speeds / (modulus * radius))
line = 2.05 * radius * moes * (load / (2 * modulus * radius) / moes) ** -0.2

left, right = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")[1]
left.plot(x * 1e3, p / 1e6, label="pressure")
left.plot(x * 1e3, hertz.pressure(np.abs(x)) / 1e6, "k:", label="dry (Hertz)")
left.set(xlabel="x [mm], flow to the right", ylabel="pressure [MPa]", xlim=(-3, 2), ylim=(0, None))
gap = left.twinx()
gap.plot(x * 1e3, h * 1e6, "C1--")
gap.set_ylim(0, 8 * h.min() * 1e6)
gap.set_ylabel("film thickness [µm]", color="C1")
left.set_title(f"{speeds[-1] * 1e3:g} mm/s")
left.legend(loc="upper left", fontsize="small")
right.loglog(speeds, np.array(thinnest) * 1e6, "o", label="thinnest place")
right.loglog(speeds, line * 1e6, "k--", label="limit of a soft roller")
right.set(xlabel="mean speed [m/s]", ylabel="film thickness [µm]")
right.set_yticks([2, 5, 10, 20], [2, 5, 10, 20])
right.minorticks_off()
right.legend()

print(f"at {speeds[-1] * 1e3:g} mm/s: {thinnest[-1] * 1e6:.2f} µm, by the limit {line[-1] * 1e6:.2f} µm")
assert abs(thinnest[-1] / line[-1] - 1) < 0.03
drawn = 1e-4 * viscosity * radius / load  # a rigid roller at 0.1 mm/s
_, h, *_ = film(1e-4, 2 * np.sqrt(2 * radius * 4.895 * drawn), soft=0.0, cells=500, inlet=20.0, outlet=0.5)
print(f"a rigid roller: {h.min() / drawn:.3f} viscosity x speed x radius / load (Martin: 4.895)")
# The pressure in front of the inlet is missing: its share falls with the square of the distance.
assert abs(h.min() / drawn / 4.895 - 1) < 0.01
