"""A surface that sticks strongly, in one step into contact: its jumps, and what the way to them takes."""

import numpy as np

import roughcontact as rc
from sticking import counted, strong

# Depth and lost energy of the jumps by bisection of the steps, with states to 1e-8 on the way.
DEPTHS = [-1.170813, -0.580732, -0.461764, -0.461551, -0.461458]
LOST = [0.00876345, 3.882193, 6.62294e-05, 1.41049e-06, 0.03519065]
MOST = 3600  # products a jump: 2926 are counted, and 4315 were by bisection


def test_one_step_meets_every_jump_within_its_products():
    surface, adhesion = strong(64)
    with counted() as counts:
        *_, end = rc.adhesive_path(surface, 1.0, adhesion, depths=[-40.0, -0.4])
    assert end.status.converged
    # The documented precision of the end of a branch is 1e-6 of the way, that of the bracket 1e-8 (BRACKET).
    assert np.allclose([jump.depth for jump in end.jumps], DEPTHS, rtol=0, atol=1e-6 * 40)
    # At a limit point the state, and with it the loss, changes with the root of the distance from it: 1e-4 of the way,
    # and more of the loss of the two jumps that are hardly longer than MOVED.
    lost = np.array([jump.lost for jump in end.jumps])
    assert np.allclose(lost, LOST, rtol=2e-3)
    assert not any(jump.ambiguous for jump in end.jumps)
    assert counts["uniform flows"] == len(end.jumps)
    assert end.products <= MOST * len(end.jumps)
    # 41 and 69 are counted; bisection rejected more steps than it accepted.
    assert counts["steps rejected"] <= 0.75 * counts["steps accepted"]
