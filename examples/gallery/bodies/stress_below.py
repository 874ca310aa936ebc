"""
Stress below a ball
===================

The equivalent stress of von Mises is largest below the surface, at about half the contact radius (Johnson,
*Contact Mechanics*, 1985, section 3.4: 0.48 a for a Poisson's ratio of 0.3).
"""

import roughcontact as rc

radius, modulus, force = 1e-2, 110e9, 1.0  # m, Pa, N
solution = rc.press(rc.shapes.paraboloid(rc.Grid((81, 81), 1e-6), radius), modulus, force=force)
rc.plot.von_mises_section(solution, 0.3)

peak = rc.largest_von_mises(solution, 0.3)
depth = peak.depth / rc.theory.hertz.point(modulus=modulus, radius=radius, force=force).contact_radius
print(f"largest at a depth of {depth:.2f} contact radii")
assert f"{depth:.2f}" == "0.48"
