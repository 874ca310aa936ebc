"""
A ball on springs
=================

In the method of dimensionality reduction, a ball is replaced by the profile x²/R. Pressed on independent
springs, this profile has the force, depth and contact radius of the ball (Popov and Heß, *Method of
Dimensionality Reduction*, 2015).
"""

import roughcontact as rc

modulus, radius, force = 110e9, 1e-2, 1.0  # Pa, m, N
line = rc.Grid(401, 5e-7)
x = line.coordinates[0] - line.coordinates[0].mean()
springs = rc.foundation(line, modulus)
solution = rc.press(rc.Surface(-(x**2) / radius, line), modulus, force=force, operator=springs)
rc.plot.contact_profile(solution)

hertz = rc.theory.hertz.point(modulus, radius=radius, force=force)
ratio = solution.depth / hertz.depth
print(f"depth relative to Hertz: {ratio:.4f}")
assert abs(ratio - 1) < (line.spacing[0] / hertz.contact_radius) ** 2  # sums of x² over cells
