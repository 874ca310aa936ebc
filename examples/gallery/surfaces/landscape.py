"""
A mountain range on granite
===========================

Elevations can be used as heights. This is the fault of Jacksboro, Tennessee, pressed by 20 000 teranewtons.
"""

import math

from matplotlib.cbook import get_sample_data

import roughcontact as rc

data = get_sample_data("jacksboro_fault_dem.npz")
degree = 6371e3 * math.pi / 180  # m of latitude, on a sphere of the Earth's mean radius
latitude = math.radians((data["ymin"] + data["ymax"]) / 2)
spacing = (data["dy"] * degree, data["dx"] * degree * math.cos(latitude))
range_ = rc.Surface(data["elevation"], rc.Grid(data["elevation"].shape, spacing)).levelled("plane")
granite = rc.Solid(young_modulus=60e9, poisson_ratio=0.25)
solution = rc.press(range_, rc.reduced_modulus(granite, granite), force=2e16)
rc.plot.pressure_map(solution)

print(f"{solution.contact_fraction:.1%} of {math.prod(range_.grid.lengths) / 1e6:.0f} km^2 in contact")
assert solution.residual < 1e-8
