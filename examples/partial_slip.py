"""A rough steel sphere on steel, pressed and pulled back and forth: what slips, and what friction takes.

The work of a cycle is compared with what Jaeger's rule makes of the normal loading curve alone. The rule is exact
without Poisson's effect: a pull then moves nothing across it, and the same body with nu = 0 shows how close it comes.
"""

import numpy as np

import roughcontact as rc

STEEL = rc.Solid(young_modulus=210e9, poisson_ratio=0.3)
UNCOUPLED = rc.Solid(young_modulus=210e9, poisson_ratio=0.0)
FRICTION = 0.3
CELLS, SPACING = 96, 1e-6
RADIUS = 2e-3  # of the sphere [m]
DEPTH = 0.6e-6
PART = 0.8  # of the force at which the bodies would slide


def rough_sphere():
    """Return a sphere with a self-affine roughness of 100 nm."""
    grid = rc.Grid((CELLS, CELLS), SPACING)
    roughness = rc.self_affine(grid, hurst=0.8, rms=100e-9, short_cutoff=8e-6, rng=np.random.default_rng(1))
    y, x = (c - c.mean() for c in grid.coordinates)
    return rc.Surface(roughness.heights - (y[:, None] ** 2 + x**2) / (2 * RADIUS), grid)


def jaegers_loss(solution, body, amplitude):
    """Return the work that friction takes in a cycle [J], from depths at smaller normal forces (Jaeger 1998)."""
    ratio = rc.reduced_modulus(body, body) / rc.reduced_shear_modulus(body, body)
    forces = np.linspace(solution.force - amplitude / FRICTION, solution.force, 20)
    depth = rc.loading_curve(solution.problem.surface, (body, body), forces=forces).depth
    pull, moved = FRICTION * (forces[-1] - forces), FRICTION * ratio * (depth[-1] - depth)
    area = ((moved[1:] + moved[:-1]) / 2 * -np.diff(pull)).sum()
    return 4 * amplitude * moved[0] - 8 * area  # Masing: the branches are the first loading, twice as large


def losses(body):
    """Print the loop, and return what friction takes in a cycle: computed, and by Jaeger's rule [J]."""
    solution = rc.press(rough_sphere(), (body, body), depth=DEPTH)
    amplitude = PART * FRICTION * solution.force
    forces = rc.load_cycle(amplitude, steps=4)
    loop = rc.slide_curve(solution, (body, body), friction=FRICTION, forces=forces)
    print(f"nu = {body.poisson_ratio:g}, pressed by {solution.force:.4g} N: {solution.spots.count} spots")
    print("  pull [N]  displacement [nm]  slipping  certificate")
    share = loop.slip_area / (loop.slip_area + loop.stick_area)
    for row in zip(loop.force[:, 0], loop.displacement[:, 0] * 1e9, share, loop.residual, strict=True):
        print("{:10.3f}{:19.2f}{:10.1%}{:13.1e}".format(*row))
    loss, expected = loop.dissipated[4:].sum(), jaegers_loss(solution, body, amplitude)
    print(f"friction takes {loss:.4g} J in a cycle, by Jaeger's rule {expected:.4g} J")
    return loss, expected


def main():
    """Print both loops, and both losses of each."""
    losses(STEEL)
    loss, expected = losses(UNCOUPLED)
    assert abs(loss / expected - 1) < 0.01, (
        "for nu = 0 the rule is exact, but for its trapezia between twenty forces"
    )


if __name__ == "__main__":
    main()
