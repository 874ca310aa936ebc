"""The picture of a cycle of shear: its data and units, with the law and without."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import roughcontact as rc


@pytest.mark.parametrize(
    ("stiff", "units"), [(1.0, ("nm", "MPa")), (1e-3, ("nm", "kPa")), (1e-6, ("nm", "Pa"))]
)
def test_loops_are_drawn_in_their_units(stiff, units):
    bodies = (rc.Solid(2e9 * stiff, 0.0),) * 2
    grid = rc.Grid((16, 20), (1e-6, 1.5e-6), periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, short_cutoff=4e-6)
    p = 4e7 * stiff
    curve = rc.loading_curve(surface, bodies, pressures=p * np.array([0.25, 0.5, 0.75, 1, 1.2]))
    law = rc.shear_law(curve, bodies, friction=0.3)
    pressed = rc.press(surface, bodies, pressure=p)
    cycle = rc.shear_cycle(pressed, bodies, friction=0.3, traction=0.15 * p, steps=2, law=law)
    axes = rc.plot.shear_loop(cycle, Figure().subplots())
    assert axes.get_xlabel() == f"tangential displacement [{units[0]}]"
    assert axes.get_ylabel() == f"nominal tangential traction [{units[1]}]"
    factor = {"MPa": 1e-6, "kPa": 1e-3, "Pa": 1.0}[units[1]]
    drawn = {line.get_label(): line.get_xydata() for line in axes.lines}
    expected = {
        "first loading": (cycle.first_displacement, cycle.first_traction),
        "cycle by partial slip": (cycle.loop.displacement, cycle.loop.traction),
        "law from the normal curve": (cycle.estimate.displacement, cycle.estimate.traction),
    }
    assert list(drawn) == list(expected)
    for name, (displacement, traction) in expected.items():
        np.testing.assert_allclose(drawn[name], np.stack([displacement * 1e9, traction * factor], axis=1))


def test_without_a_law_and_in_micrometres():
    ball = rc.shapes.paraboloid(rc.Grid((16, 20), (1e-4, 1.2e-4)), radius=1e-2)
    pressed = rc.press(ball, rc.Solid(1e7, 0.5), force=1.0)
    cycle = rc.shear_cycle(
        pressed, rc.Solid(1e7, 0.5), friction=0.5, traction=0.25 * pressed.nominal_pressure, steps=1
    )
    axes = cycle.plot(Figure().subplots())
    assert axes.get_xlabel() == "tangential displacement [µm]"
    assert [line.get_label() for line in axes.lines] == ["first loading", "cycle by partial slip"]
    np.testing.assert_allclose(axes.lines[1].get_xdata(), cycle.loop.displacement * 1e6)
    assert [text.get_text() for text in axes.get_legend().get_texts()] == [
        line.get_label() for line in axes.lines
    ]
