"""
Pull-off of an adhesive ball (JKR)
==================================

Force against depth of a ball with short-ranged attraction (Johnson, Kendall and Roberts), by Heß' rule.
Under a given force the ball snaps off at 3/2 pi w R; under a given depth it snaps off later.
"""

import matplotlib.pyplot as plt
import numpy as np

from roughcontact.mdr import adhesion, indenter

radius, modulus, work = 1e-3, 1e6, 0.05  # m, Pa, J/m^2
ball = adhesion.jkr(indenter.paraboloid(radius), modulus, work)
by_force, by_depth = ball.pull_off(), ball.pull_off(machine_stiffness=np.inf)

radii = np.linspace(1e-6, 1.2e-4, 300)
axes = plt.subplots()[1]
axes.plot(ball.depth(radii) * 1e6, ball.force(radii) * 1e3)
axes.plot(by_force.depth * 1e6, by_force.force * 1e3, "o", label="snaps off under a given force")
axes.plot(by_depth.depth * 1e6, by_depth.force * 1e3, "s", label="snaps off under a given depth")
axes.set(xlabel="depth [µm]", ylabel="force [mN]")
axes.legend()

ratio = by_force.force / (-1.5 * np.pi * work * radius)
print(f"pull-off over 3/2 pi w R: {ratio:.6f}")
assert abs(ratio - 1) < 1e-6
