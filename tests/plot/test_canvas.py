"""Whole figures: nothing overlaps, nothing global is touched, files are whole or not there."""

from __future__ import annotations

import subprocess
import sys
from itertools import combinations

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.container import ErrorbarContainer
from matplotlib.figure import Figure
from matplotlib.text import Text

import roughcontact as rc
from roughcontact.files.aside import WriteError
from roughcontact.labels.engineering_units import written
from roughcontact.plot.canvas import areal_figure, curve_figure, save, solution_figure, surface_figure

MODULUS = 1e11


def rough(shape: tuple[int, int], periodic: bool = False) -> rc.Surface:
    return rc.self_affine(
        rc.Grid(shape, (1e-7, 1e-7), periodic), hurst=0.8, rms=1e-7, rng=np.random.default_rng(3)
    )


def overlaps(figure: Figure) -> list[tuple[str, str]]:
    """Return the pairs of texts that are drawn over one another by more than a hair."""
    canvas = FigureCanvasAgg(figure)
    figure.draw_without_rendering()  # the layout settles, once as in a picture that is saved
    figure.set_layout_engine("none")
    drawn: list[Text] = []
    draw = Text.draw

    def note(text: Text, renderer: object) -> None:
        if text.get_visible() and text.get_text().strip():
            drawn.append(text)
        draw(text, renderer)

    # Ticks beyond the ends of an axis have texts too, which are never drawn: only drawing tells.
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Text, "draw", note)
        canvas.draw()
    boxes = [(text.get_text(), text.get_window_extent(canvas.get_renderer())) for text in drawn]
    assert len(boxes) > 10
    found = []
    for (one, a), (two, b) in combinations(boxes, 2):
        wide = min(a.x1, b.x1) - max(a.x0, b.x0)
        high = min(a.y1, b.y1) - max(a.y0, b.y0)
        if wide > 1 and high > 1:  # pixels
            found.append((one, two))
    return found


@pytest.mark.parametrize("shape", [(32, 32), (20, 64), (64, 20)])
def test_no_text_overlaps_on_maps(shape):
    solution = rc.press(rough(shape), MODULUS, force=1e-4)
    assert overlaps(solution_figure(solution)) == []
    assert overlaps(surface_figure(rough(shape))) == []


@pytest.mark.parametrize("periodic", [False, True])
def test_no_text_overlaps_on_curves(periodic):
    surface = rough((48, 48), periodic)
    scale = MODULUS * 1e-7 * 48e-7
    curve = rc.loading_curve(surface, MODULUS, forces=scale * np.geomspace(1e-3, 0.5, 12))
    law = curve.fit((float(curve.force[0]), float(curve.force[-1])))
    assert overlaps(curve_figure(curve, law)) == []
    assert overlaps(curve_figure(curve)) == []
    assert overlaps(areal_figure(curve, law)) == []


def bars(axes):
    return [each for each in axes.containers if isinstance(each, ErrorbarContainer)]


@pytest.mark.parametrize("per_area", [False, True])
def test_errors_are_bars_and_what_other_maps_would_give_is_written_below(per_area):
    surface = rough((48, 48)).levelled("plane")
    forces = MODULUS * 1e-7 * 48e-7 * np.geomspace(1e-3, 0.5, 12)
    curve = rc.loading_curve(surface, MODULUS, forces=forces)
    errors = {
        float(force): rc.error_budget(rc.press(surface, MODULUS, force=force)) for force in forces[[0, -1]]
    }
    light, heavy = (budget["stiffness"].error for budget in errors.values())
    assert np.isnan(light)  # a few spots: its error is unknown
    assert heavy > 0
    figure = (areal_figure if per_area else curve_figure)(curve, errors=errors)
    plain = (areal_figure if per_area else curve_figure)(curve)
    names = ("interfacial_stiffness_per_area", "contact_fraction", "mean_gap")
    for axes, bare, name in zip(
        figure.axes[:3],
        plain.axes[:3],
        names if per_area else ("stiffness", "contact_area", "depth"),
        strict=True,
    ):
        assert bars(bare) == []
        known = errors[float(forces[-1])][name]
        if name == "depth":  # of a map that is rough to its cells
            assert np.isnan(known.error)
            assert bars(axes) == []
            assert axes.get_ylim() == bare.get_ylim()
            continue
        (bar,) = bars(axes)
        ((low, high),) = (segment[:, 1] for segment in bar.lines[2][0].get_segments())
        bottom, top = axes.get_ylim()
        assert bottom < low < high < top
        assert (bottom, top) != bare.get_ylim() or name == "stiffness"
        assert (high - low) / (high + low) == pytest.approx(known.relative_error, rel=1e-9)
    first, last = figure.get_supxlabel().split("\n")
    pressure = forces[0] / surface.grid.area
    assert first.startswith(f"at {pressure / 1e9:.3g} GPa, " if per_area else "at 48 ")
    assert ("[GPa]" in figure.axes[0].get_xlabel()) == per_area
    assert "too few to estimate" in first
    assert "sampling, in order of magnitude: interfacial stiffness" in last
    assert plain.get_supxlabel() == ""
    assert set(overlaps(figure)) <= set(overlaps(plain))


def test_below_a_pressure_map_stands_what_other_maps_would_give():
    surface = rough((32, 32)).levelled("plane")
    solution = rc.press(surface, MODULUS, force=1e-4)
    budget = rc.error_budget(solution)
    figure = solution_figure(solution, budget)
    assert figure.get_supxlabel().endswith(budget.sampling)
    assert solution_figure(solution).get_supxlabel() == ""
    assert overlaps(figure) == []
    ball = rc.press(rc.shapes.paraboloid(surface.grid, radius=1e-5), MODULUS, force=1e-4)
    assert solution_figure(ball, rc.error_budget(ball)).get_supxlabel() == ""


def test_the_picture_of_a_surface_rings_its_spikes_beside_its_distribution():
    heights = rough((20, 64)).heights.copy()
    heights[7, 11] += 1e-4
    surface = rc.Surface(heights, rc.Grid((20, 64), (2e-7, 1e-7)))
    heights_drawn, distribution = surface_figure(surface, rc.find_spikes(surface)).axes
    (rings,) = heights_drawn.collections
    np.testing.assert_allclose(rings.get_offsets(), [(1.15, 1.5)], rtol=1e-12)  # um
    assert len(distribution.patches[0].get_data().values) == 22  # Rice: twice the cube root of 1280
    trace = np.random.default_rng(2).normal(0.0, 1e-9, 500)
    trace[11] += 1e-6
    scan = rc.Surface(trace, rc.Grid(500, 1e-7))
    profile, _ = surface_figure(scan, rc.find_spikes(scan)).axes
    _, marks = profile.lines
    np.testing.assert_allclose(marks.get_xdata(), [1.15], rtol=1e-12)


@pytest.mark.parametrize(("shape", "beside"), [((40, 48), True), ((48, 20), True), ((20, 48), False)])
def test_two_wide_maps_lie_above_one_another_under_a_summary(shape, beside):
    solution = rc.press(rough(shape), MODULUS, force=2e-3)
    figure = solution_figure(solution)
    figure.canvas.draw()
    first, second = (axes.get_position() for axes in figure.axes[:2])
    assert (first.x1 <= second.x0) == beside
    assert (first.y0 >= second.y1) != beside
    stiffness = written(solution.stiffness, "N m-1")
    assert stiffness != written(solution.interfacial_stiffness, "N m-1")
    assert figure.get_suptitle() == (
        f"force 2 mN,  depth {written(solution.depth, 'm')},  stiffness {stiffness},  "
        f"contact {100 * solution.contact.mean():.3g} % in {solution.spots.count} spots"
    )


def test_the_frame_shows_what_is_enlarged():
    heights = np.zeros((128, 160))
    heights[20, 30] = 1e-6
    solution = rc.press(rc.Surface(heights, rc.Grid((128, 160), (2e-6, 1e-6))), MODULUS, force=1e-3)
    figure = solution_figure(solution)
    whole, enlarged = figure.axes
    frame = whole.lines[0]
    assert (min(frame.get_xdata()), max(frame.get_xdata())) == enlarged.get_xlim()
    assert (max(frame.get_ydata()), min(frame.get_ydata())) == enlarged.get_ylim()
    low, high = enlarged.get_xlim()
    assert low < 30.5 < high
    high, low = enlarged.get_ylim()
    assert low < 41 < high
    assert figure.get_suptitle() == (
        f"force 1 mN,  depth {written(solution.depth, 'm')},  stiffness {written(solution.stiffness, 'N m-1')},  "
        "contact 0.00488 % in 1 spot"  # one of 20480 cells
    )


def test_the_largest_pressure_is_told_where_it_lies_beside_the_frame():
    """A lone tower, higher than the many that carry the most load."""
    heights = np.zeros((128, 160))
    heights[20:41:5, 20:41:5] = 1e-6
    heights[100, 110] = 1.2e-6
    solution = rc.press(rc.Surface(heights, rc.Grid((128, 160), (2e-6, 4e-6))), MODULUS, depth=4e-7)
    assert solution.pressure.argmax() == 100 * 160 + 110
    figure = solution_figure(solution)
    low, high = figure.axes[1].get_xlim()
    assert not low < 442 < high
    inside, beside = figure.axes[1].get_title().split("\n")
    shown = solution.pressure[:64, :64].max()
    assert inside == f"pressure in the frame, at most {written(float(shown), 'Pa')}"
    most = written(float(solution.pressure.max()), "Pa")
    assert beside == f"on the map at most {most}, at x = 442 µm, y = 201 µm"
    assert overlaps(figure) == []


@pytest.mark.parametrize(
    ("ending", "magic"), [("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml"), ("PNG", b"\x89PNG")]
)
def test_pictures_are_what_their_names_say(ending, magic, tmp_path):
    save(surface_figure(rough((8, 8))), tmp_path / f"a.{ending}")
    assert (tmp_path / f"a.{ending}").read_bytes().startswith(magic)
    assert len(list(tmp_path.iterdir())) == 1


@pytest.mark.parametrize("name", ["a.xyz", "a"])
def test_other_endings_are_refused(name, tmp_path):
    with pytest.raises(WriteError, match="png, pdf, svg"):
        save(Figure(), tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_picture_leaves_nothing(tmp_path):
    class Interrupted(Figure):
        def savefig(self, path, **_):
            path.write_bytes(b"half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        save(Interrupted(), tmp_path / "a.png")
    assert list(tmp_path.iterdir()) == []


def test_no_pyplot_and_no_settings_are_touched(tmp_path):
    program = (
        "import sys, numpy as np, matplotlib; before = matplotlib.rcParams.copy();"
        "import roughcontact as rc; from roughcontact.plot.canvas import surface_figure, save;"
        "save(surface_figure(rc.Surface(np.eye(4), rc.Grid((4, 4), 1.0))), sys.argv[1]);"
        "assert 'matplotlib.pyplot' not in sys.modules; assert matplotlib.rcParams.copy() == before"
    )
    command = [sys.executable, "-c", program, str(tmp_path / "a.png")]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("periodic", [False, True])
def test_a_joint_of_flat_faces_has_a_picture(periodic):
    """Infinitely stiff from the first load on: no point has a place on the axes."""
    flat = rc.Surface(np.zeros((8, 8)), rc.Grid((8, 8), 1e-6, periodic))
    curve = rc.loading_curve(flat, MODULUS, pressures=[1e6, 2e6])
    assert np.isinf(curve.interfacial_stiffness_per_area).all()
    FigureCanvasAgg(areal_figure(curve)).draw()
