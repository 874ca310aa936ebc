"""
An operator of your own
=======================

A half-space under a film of springs, such as a lacquer: any object with these five members may be pressed on.
The film evens out the pressure, and adds at least its compliance under an even one, at most that under the
pressure without it.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc


class Coated:
    """A body under a film whose compliance is in m/Pa."""

    def __init__(self, body, film):
        self.body, self.film = body, film
        self.grid, self.weights = body.grid, body.weights

    def apply(self, pressure):
        return self.body.apply(pressure) + self.film * pressure

    def as_matrix(self, cells=None):
        matrix = self.body.as_matrix(cells)
        return matrix + self.film * np.eye(len(matrix))

    def restrict(self, window):
        return Coated(self.body.restrict(window), self.film)


grid, modulus = rc.Grid((48, 48), 1e-6), 1e9
disc = rc.shapes.flat_disc(grid, 15e-6)
bare = rc.half_space(grid, modulus)
axes = plt.subplots()[1]
for film in 0.0, 1e-15, 1e-14:  # m/Pa: 1 µm of film of 1 GPa has 1e-15
    solution = rc.press(disc, modulus, force=1e-3, operator=Coated(bare, film) if film else bare)
    axes.plot(solution.pressure[24] / 1e6, drawstyle="steps-mid", label=f"film of {film:.0e} m/Pa")
axes.set(xlabel="x [µm]", ylabel="pressure [MPa]")
axes.legend()

hard = rc.press(disc, modulus, force=1e-3)
added = (1 / solution.stiffness - 1 / hard.stiffness) * solution.contact_area / film
uneven = np.mean(hard.pressure[disc.measured] ** 2) / np.mean(hard.pressure[disc.measured]) ** 2
print(f"the film adds {added:.3f} of its compliance under an even pressure; at most {uneven:.3f}")
assert 1 < added < uneven  # of the energy of the film, least under an even pressure
