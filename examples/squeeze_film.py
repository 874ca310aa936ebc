"""A soft ball that falls on a flat through a film of oil: axisymmetric squeeze film.

Reynolds' equation (1/r) d/dr (r h^3/(12 eta) dp/dr) = dh/dt on the displacement of `roughcontact.ring`:
h = h0(t) + r^2/(2R) + u(p), u by `Operator.apply`. Under a constant force a rigid ball keeps falling for ever,
F = 6 pi eta R^2 V/h0; a soft one traps oil in a dimple, and its pressure becomes that of Hertz.

    python examples/squeeze_film.py
"""

import numpy as np

import roughcontact as rc

E, R, FORCE = 1e6, 0.01, 0.5  # reduced modulus [Pa], radius [m], force [N]; the viscosity is in the time
HERTZ = (3 * FORCE * R / (4 * E)) ** (1 / 3)  # contact radius [m]


class Film:
    """Pressure and thickness on rings; one implicit step in time at a time.

    Lengths along the film count in Hertz' radius a, thickness in a^2/R, pressure in F/a^2, time in 12 eta R^2/F.
    """

    def __init__(self, thickness, soft, rings=200, reach=4.0):
        grid = rc.RadialGrid.uniform(rings, reach)
        self.r, self.edges, self.areas = grid.radii, grid.edges, grid.cell_area
        self.dr = grid.spacing[0]
        body = rc.ring(grid, 1.0)
        # u [a^2/R] = (F/a^2) a/E* (R/a^2) times the displacement in units of a
        self.soft = soft * FORCE * R / (E * HERTZ**3)
        self.apply, self.matrix = body.apply, self.soft * body.as_matrix()
        self.p, self.h0, self.time = np.zeros(rings), thickness, 0.0

    def thickness(self, p, h0):
        """Return h at the middle of the rings."""
        return h0 + self.r**2 / 2 + self.soft * self.apply(p)

    def step(self, dt):
        """Advance by `dt`, by Newton's method for pressure and h0 at the end of the step."""
        n, p, h0 = len(self.p), self.p.copy(), self.h0
        before = self.thickness(p, h0)
        eye, inner = np.eye(n), 2 * np.pi * self.edges[1:-1] / self.dr
        for _ in range(40):
            h = self.thickness(p, h0)
            face, drop = (h[1:] + h[:-1]) / 2, np.diff(p)
            # Outflow through the circles; outside the last one the pressure is ambient.
            rim = 2 * np.pi * self.edges[-1] / (self.dr / 2) * h[-1] ** 3
            q = np.r_[0.0, -inner * face**3 * drop, rim * p[-1]]
            by_h = (-3 * inner * face**2 * drop)[:, None] * (self.matrix[1:] + self.matrix[:-1]) / 2
            by_p = -(inner * face**3)[:, None] * (eye[1:] - eye[:-1]) + by_h
            last = rim * eye[-1] + 3 * rim / h[-1] * p[-1] * self.matrix[-1]
            slopes = (
                np.diff(np.vstack([np.zeros(n), by_p, last]), axis=0) + self.areas[:, None] / dt * self.matrix
            )
            by_h0 = (
                np.diff(np.r_[0.0, -3 * inner * face**2 * drop, 3 * rim / h[-1] * p[-1]]) + self.areas / dt
            )
            balance = np.diff(q) + self.areas * (h - before) / dt
            system = np.block([[slopes, by_h0[:, None]], [self.areas[None], np.zeros((1, 1))]])
            step = np.linalg.solve(system, np.r_[-balance, 1 - self.areas @ p])
            p, h0 = p + step[:-1], h0 + step[-1]
            if np.abs(step[:-1]).max() < 1e-10 * np.abs(p).max():
                self.p, self.h0, self.time = p, h0, self.time + dt
                return self.thickness(p, h0)
        raise RuntimeError("Newton's method did not end")


def main():
    """Print the speed of a rigid ball beside the closed form, and the end of a soft one beside Hertz."""
    # In these units F = 6 pi eta R^2 V/h0 reads V = (2/pi) h0.
    rigid = Film(0.002, soft=0.0, rings=800, reach=2.0)
    dt = 1e-3 * np.pi / 2
    h = rigid.h0
    rigid.step(dt)
    speed = (h - rigid.h0) / dt
    print(f"rigid: F h0/(6 pi eta R^2 V) = {2 / np.pi * rigid.h0 / speed:.4f}")
    soft = Film(2.0, soft=1.0)
    for dt in np.geomspace(1e-3, 3e3, 60):
        h = soft.step(dt)
    hertz = 1.5 / np.pi * np.sqrt(np.maximum(1 - soft.r**2, 0))
    inside = soft.r < 0.8
    print(
        f"soft: largest deviation from Hertz' pressure {np.abs(soft.p - hertz)[inside].max() / hertz.max():.3f}"
    )
    print(f"soft: film in the middle {h[0]:.4f}, thinnest {h.min():.4f} at r = {soft.r[h.argmin()]:.3f} a")


if __name__ == "__main__":
    main()
