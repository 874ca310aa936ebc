"""
Write your own operator
=======================

A half-space under a film of springs, such as a lacquer. Any object with these five members can be used as an
operator. The film adds at least its compliance under a uniform pressure, and at most its compliance under
the pressure without film.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc


class Coated:
    def __init__(self, body, film):
        self.body, self.film, self.grid, self.weights = body, film, body.grid, body.weights

    def apply(self, pressure):
        return self.body.apply(pressure) + self.film * pressure

    def as_matrix(self, cells=None):
        matrix = self.body.as_matrix(cells)
        return matrix + self.film * np.eye(len(matrix))

    def restrict(self, window):
        return Coated(self.body.restrict(window), self.film)


grid, modulus, film = rc.Grid((48, 48), 1e-6), 1e9, 1e-14  # m/Pa: 10 µm of 1 GPa
disc, coated = rc.shapes.flat_disc(grid, 15e-6), Coated(rc.half_space(grid, modulus), film)
hard, soft = (rc.press(disc, modulus, force=1e-3, operator=each) for each in (None, coated))
pressures = np.transpose([hard.pressure[24], soft.pressure[24]]) / 1e6
plt.plot(pressures, drawstyle="steps-mid", label=["bare", "under a film"])
plt.gca().set(xlabel="x [µm]", ylabel="pressure [MPa]")
plt.legend()

added = (1 / soft.stiffness - 1 / hard.stiffness) * soft.contact_area / film
uneven = np.mean(hard.pressure[disc.measured] ** 2) / np.mean(hard.pressure[disc.measured]) ** 2
print(f"the film adds {added:.3f} times its compliance under a uniform pressure, at most {uneven:.3f} times")
assert 1 < added < uneven  # the energy of the film is least under a uniform pressure
