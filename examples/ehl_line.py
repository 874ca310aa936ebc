"""A cylinder that rolls on a soft half-space with a film of oil in between: elastohydrodynamic line contact.

Reynolds' equation for a steady, isoviscous film, d/dx (h^3/(12 eta) dp/dx) = U dh/dx with p >= 0, on the
displacement of `roughcontact.line`: h = h0 + x^2/(2R) + u(p), u by `Operator.apply`. The rigid limit is Martin's film
h0 = 4.8950 eta U R/P' (P' the load per length), the soft one that of Herrebrugh and Moes, H = 2.05 M^(-1/5).

    python examples/ehl_line.py
"""

import numpy as np

import roughcontact as rc

E, R, LOAD = 1e9, 0.01, 5e4  # reduced modulus [Pa], radius [m], load per length [N/m]


def film(eta_u, soft, start=None, cells=300, inlet=4.0, outlet=1.5):
    """Return the thickness h [m], the pressure [Pa] and a state to start from, at viscosity times speed `eta_u` [N/m].

    Semismooth Newton: where the film breaks the pressure is zero, elsewhere the flow balances; the load fixes h0.
    Lengths count in half widths b, thickness in b^2/R, pressure in P'/b.
    """
    martin = 4.895 * eta_u * R / LOAD
    b = np.sqrt(4 * LOAD * R / (np.pi * E)) if soft else 2 * np.sqrt(2 * R * martin)
    thickness, pressure = b * b / R, LOAD / b
    grid = rc.Grid(cells, (inlet + outlet) * b / cells)
    dx, x = grid.spacing[0] / b, grid.coordinates[0] / b - inlet
    body = rc.line(grid, E)
    compliance = body.as_matrix() * (pressure / thickness) * soft  # slopes for Newton's method
    drive = 12 * eta_u * b / (thickness**2 * pressure)

    def shape(p, h0):
        return h0 + x**2 / 2 + soft * body.apply(p * pressure) / thickness

    def flow(p, h0):
        """Return the imbalance of the flow into every cell and its slopes by p and by h0."""
        h = shape(p, h0)
        face, drop = (h[1:] + h[:-1]) / 2, np.diff(p) / dx
        # In front the pressure is ambient half a cell outside; behind the film is carried away.
        q = np.r_[drive * h[0] - h[0] ** 3 * p[0] / (dx / 2), drive * face - face**3 * drop, drive * h[-1]]
        by_h = drive - 3 * face**2 * drop
        eye = np.eye(cells)
        inner = by_h[:, None] * (compliance[1:] + compliance[:-1]) / 2 - (face**3 / dx)[:, None] * (
            eye[1:] - eye[:-1]
        )
        slope = drive - 3 * h[0] ** 2 * p[0] / (dx / 2)
        front = slope * compliance[0] - h[0] ** 3 / (dx / 2) * eye[0]
        by_p = np.diff(np.vstack([front, inner, drive * compliance[-1]]), axis=0)
        return np.diff(q), by_p, np.diff(np.r_[slope, by_h, drive])

    p, h0 = start or (np.maximum(1 - x**2, 0) * 0.75, martin / thickness)
    for _ in range(100):
        r, by_p, by_h0 = flow(p, h0)
        broken = p - r / np.abs(by_p.diagonal()).max() <= 0
        system = np.block([[by_p, by_h0[:, None]], [np.full((1, cells), dx), np.zeros((1, 1))]])
        right = np.r_[-r, 1 - p.sum() * dx]
        system[:cells][broken] = np.eye(cells, cells + 1)[broken]
        right[:cells][broken] = -p[broken]
        step = np.linalg.solve(system, right)
        h = shape(p, h0)
        change = shape(p + step[:-1], h0 + step[-1]) - h
        part = min(1.0, 0.5 / max((-change / h).max(), 1e-9))  # a film must not close in one step
        p, h0 = p + part * step[:-1], h0 + part * step[-1]
        if part == 1 and np.abs(step[:-1]).max() < 1e-10 * p.max():
            return shape(p, h0) * thickness, p * pressure, (p, h0)
    raise RuntimeError("Newton's method did not end")


def main():
    """Print the rigid and the soft film beside their asymptotes."""
    eta_u = 1e-2
    h, _, _ = film(eta_u, soft=False, cells=800, inlet=30.0, outlet=0.5)
    print(f"rigid: h0 P'/(eta U R) = {h.min() * LOAD / (eta_u * R):.4f} (Martin: 4.8950)")
    state = None
    for eta_u in np.geomspace(100, 0.1, 7):
        h, _, state = film(eta_u, True, state)
        unit = np.sqrt(2 * eta_u / (2 * E * R))  # Moes counts the sum of both speeds, and E' = 2 E*
        m, number = LOAD / (2 * E * R) / unit, h.min() / R / unit
        print(f"soft: M = {m:.1f}, H = {number:.3f} (2.05 M^(-1/5) = {2.05 * m**-0.2:.3f})")


if __name__ == "__main__":
    main()
