"""Figure 16: the stepped indenter just before each of its cylinders touches."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

import roughcontact as rc
from roughcontact.theory.spheres_and_punches import punch
from roughcontact_thesis import fig16_stepped_contact as fig16
from roughcontact_thesis.figures import drawn, verdicts
from roughcontact_thesis.stepped_body import INDENTER, MODULUS, RINGS, full_steps, stepped_body

# Stiffnesses of discs and annuli of 32 rings are 1.7e-4 low, and the outermost ring of a step touches where its middle
# does: a rim later by (pi/32)^2/8 of the step's width.
RULE = 5e-4


@pytest.fixture(scope="module")
def states():
    return fig16.case()


def test_the_first_state_is_a_flat_disc_of_which_all_is_known(states):
    state = states[0]
    # The surface around the disc sinks by (2/pi) d asin(r0/r): by d/3 at the rim r1 = 2 r0, so d - d/3 = h0.
    assert state.depth == pytest.approx(1.5 * INDENTER.height, rel=RULE)
    assert state.stiffness == pytest.approx(2 * MODULUS * INDENTER.radius, rel=RULE)
    assert state.force == pytest.approx(3 * MODULUS * INDENTER.radius * INDENTER.height, rel=2 * RULE)
    radii = state.problem.grid.radii
    outside = radii > INDENTER.radius
    exact = punch.disc_displacement(state.depth, INDENTER.radius, radii[outside])
    # Rings next to the edge are as wide as their distance from it, where the slope has no bound.
    apart = radii[outside] > 1.05 * INDENTER.radius
    np.testing.assert_allclose(state.displacement[outside][apart], exact[apart], rtol=2e-3)


def test_each_state_ends_at_the_rim_of_its_cylinder_and_leaves_a_gap_behind_the_last(states):
    body = stepped_body(INDENTER, fig16.COUNT + 1)
    for n, state in enumerate(states):
        touching = np.flatnonzero(state.contact)
        assert body.grid.edges[touching[-1] + 1] == pytest.approx(INDENTER.radii(n + 1)[-1], rel=1e-12)
        gap = state.displacement - body.heights - state.depth
        # The next cylinder just touches at its rim, and nothing overlaps.
        assert gap[(n + 2) * RINGS - 1] == pytest.approx(0, abs=1e-8)
        assert gap.min() > -1e-6
        if n:
            # Beside a step the surface would have to sink at once.
            assert not state.contact[n * RINGS]


def test_the_states_are_those_of_the_whole_body_at_their_depths(states):
    body = stepped_body(INDENTER, fig16.COUNT + 1)
    whole = rc.press(body, MODULUS, depth=states[1].depth)
    assert whole.force == pytest.approx(states[1].force, rel=1e-6)


def test_rings_converge(states):
    body = stepped_body(INDENTER, fig16.COUNT + 1, 2 * RINGS)
    finer = full_steps(body, rc.ring(body.grid, MODULUS), fig16.COUNT, 2 * RINGS)
    for one, other in zip(states, finer, strict=True):
        assert one.force == pytest.approx(other.force, rel=2 * RULE)
    assert states[0].stiffness == pytest.approx(finer[0].stiffness, rel=2 * RULE)
    for n in (1, 2):
        # Where contact ends on a step it ends with a ring: the stiffness is known to the share of that ring.
        wider = states[n].contact.copy()
        wider[np.flatnonzero(wider[n * RINGS :])[0] + n * RINGS - 1] = True
        share = rc.contact_stiffness(wider, states[n].problem.grid, MODULUS) / states[n].stiffness - 1
        assert 0 < share < 5e-3
        assert states[n].stiffness == pytest.approx(finer[n].stiffness, rel=2 * RULE + share)


def test_it_is_drawn_and_judged(states):
    FigureCanvasAgg(drawn(fig16, states)).draw()
    assert [each.word for each in verdicts(fig16, states)] == ["holds"]
