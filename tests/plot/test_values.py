"""Values that draw themselves, in Python and in a notebook, and the tables that they become."""

from __future__ import annotations

import base64
import inspect
import subprocess
import sys
from html.parser import HTMLParser

import numpy as np
import pytest
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.plot.facts import quantity

MODULUS = 1e11


@pytest.fixture(scope="module")
def surface():
    grid = rc.Grid((32, 40), (1e-7, 1e-7))
    return rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(3))


@pytest.fixture(scope="module")
def solution(surface):
    return rc.press(surface, MODULUS, force=1e-3)


@pytest.fixture(scope="module")
def curve(surface):
    scale = MODULUS * surface.rms * 36e-7
    return rc.loading_curve(surface, MODULUS, forces=scale * np.geomspace(3e-3, 1, 40))


def fitted(curve):
    return curve.fit((float(curve.force[0]), float(curve.force[-1])))


def on_a_line(kind):
    if kind == "ring":
        grid = rc.RadialGrid(np.r_[0, np.cumsum(np.linspace(1e-6, 3e-6, 40))])
        return rc.RadialProfile(-(grid.radii**2) / 2, grid), rc.ring(grid, MODULUS)
    grid = rc.Grid(200, 1e-6)
    profile = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(3))
    return profile, rc.line(grid, MODULUS) if kind == "line" else rc.foundation(grid, MODULUS)


DRAWING = [name for name in rc.plot.__all__ if not name.endswith("figure") and name not in ("save", "Scale")]


@pytest.mark.parametrize("name", DRAWING)
def test_functions_take_axes_or_none_and_return_them(name):
    """What is drawn comes first and has no default but names; then the axes; the rest by name alone."""
    signature = inspect.signature(getattr(rc.plot, name))
    assert signature.return_annotation in ("Axes", "Axes3D")
    kinds = [each.kind for each in signature.parameters.values()]
    place = list(signature.parameters).index("ax")
    assert signature.parameters["ax"].default is None
    assert set(kinds[: place + 1]) == {inspect.Parameter.POSITIONAL_OR_KEYWORD}
    assert set(kinds[place + 1 :]) <= {inspect.Parameter.KEYWORD_ONLY}


def test_methods_draw_on_the_axes_that_they_are_given_and_make_their_own_without(surface, solution, curve):
    for value in (surface, solution, curve):
        axes = Figure().subplots()
        assert value.plot(axes) is axes
        assert value.plot(ax=axes) is axes
        assert pyplot.get_fignums() == []
        made = value.plot()
        assert isinstance(made, Axes)
        assert [pyplot.figure(number) for number in pyplot.get_fignums()] == [made.figure]
        pyplot.close("all")


def test_a_view_makes_axes_of_three_dimensions(surface):
    axes = rc.plot.surface_view(surface)
    assert axes.name == "3d"
    assert [pyplot.figure(number) for number in pyplot.get_fignums()] == [axes.figure]


def test_a_surface_draws_its_heights(surface):
    axes = surface.plot()
    np.testing.assert_allclose(np.asarray(axes.images[0].get_array()), surface.heights * 1e9, rtol=1e-14)
    profile = rc.Surface(surface.heights[0], rc.Grid(40, 1e-7))
    np.testing.assert_allclose(profile.plot().lines[0].get_ydata(), surface.heights[0] * 1e9, rtol=1e-14)


def test_the_spikes_of_a_profile_are_marked():
    heights = np.random.default_rng(2).normal(0.0, 1e-9, 500)
    heights[[100, 300]] += 1e-6
    profile = rc.Surface(heights, rc.Grid(500, 1e-6))
    spikes = rc.find_spikes(profile)
    _, marks = profile.plot(spikes=spikes).lines
    np.testing.assert_allclose(marks.get_xdata(), [100.5, 300.5], rtol=1e-12)  # um
    np.testing.assert_allclose(marks.get_ydata(), heights[[100, 300]] * 1e6, rtol=1e-12)
    assert profile.plot(spikes=spikes).get_title() == str(spikes) == "2 spikes of 2 cells"


def test_a_solution_draws_its_pressure_or_its_contact(solution):
    image = solution.plot().images[-1]
    drawn = np.ma.masked_invalid(image.get_array())
    np.testing.assert_array_equal(~np.ma.getmaskarray(drawn), solution.contact)
    np.testing.assert_allclose(drawn.compressed(), solution.pressure[solution.contact] * 1e-9, rtol=1e-14)
    touched = np.ma.masked_invalid(solution.plot(field="contact").images[-1].get_array())
    np.testing.assert_array_equal(~np.ma.getmaskarray(touched), solution.contact)
    with pytest.raises(ValueError, match="field must be 'pressure' or 'contact', not 'gap'"):
        solution.plot(field="gap")


@pytest.mark.parametrize(
    ("kind", "unit", "along"), [("ring", "MPa", "r"), ("line", "GPa", "x"), ("foundation", "kN/m", "x")]
)
def test_lines_and_rings_draw_curves(kind, unit, along):
    body, operator = on_a_line(kind)
    solution = rc.press(body, MODULUS, depth=3e-10 if kind == "ring" else 1e-6, operator=operator)
    assert solution.contact.sum() > 2
    axes = solution.plot()
    (steps,) = axes.patches
    values, edges, _ = steps.get_data()
    factor = {"MPa": 1e-6, "GPa": 1e-9, "kN/m": 1e-3}[unit]
    np.testing.assert_allclose(values, solution.pressure * factor, rtol=1e-14)
    grid = solution.problem.grid
    expected = grid.edges if kind == "ring" else np.arange(201) * 1e-6
    np.testing.assert_allclose(edges, expected * 1e6, rtol=1e-12, atol=1e-20)
    assert (axes.get_xlabel(), axes.get_ylabel()) == (f"{along} [µm]", f"pressure [{unit}]")
    axes = solution.plot(field="contact")
    before, under = axes.lines
    for drawn, heights in ((before, solution.depth - solution.problem.separation), (under, -solution.gap)):
        np.testing.assert_allclose(drawn.get_xdata(), grid.coordinates[0] * 1e6, rtol=1e-12)
        np.testing.assert_allclose(drawn.get_ydata() * heights[0], drawn.get_ydata()[0] * heights, rtol=1e-12)
    cells = np.flatnonzero(solution.contact)
    ends = [segment[:, 0] for segment in axes.collections[0].get_segments()]
    np.testing.assert_allclose(ends, np.stack([edges[cells], edges[cells + 1]], axis=1), rtol=1e-14)
    figure = rc.plot.solution_figure(solution)
    assert len(figure.axes) == 2
    assert figure.get_suptitle().startswith("force ")
    assert ("/m," in figure.get_suptitle().split("depth")[0]) is (kind == "line")
    figure.draw_without_rendering()


def test_a_map_is_no_profile_and_a_profile_no_map(solution):
    """What is refused leaves no empty figure behind."""
    with pytest.raises(ValueError, match="pressure_map or contact_map"):
        rc.plot.pressure_profile(solution)
    body, operator = on_a_line("line")
    with pytest.raises(ValueError, match="draw the profile"):
        rc.plot.pressure_map(rc.press(body, MODULUS, depth=1e-7, operator=operator))
    with pytest.raises(ValueError, match="draw the profile"):
        rc.plot.height_map(body)
    assert pyplot.get_fignums() == []


@pytest.mark.parametrize(
    "quantity",
    ["stiffness", "contact_area", "depth", "interfacial_stiffness_per_area", "contact_fraction", "mean_gap"],
)
def test_a_curve_draws_the_quantity_that_is_named(curve, quantity):
    axes = curve.plot(quantity=quantity)
    (points,) = [line for line in axes.lines if line.get_label() == "resolved"]
    values = np.asarray(getattr(curve, quantity))[curve.resolved]
    load = curve.force if quantity in ("stiffness", "contact_area", "depth") else curve.nominal_pressure
    # Units are powers of ten.
    np.testing.assert_allclose(points.get_ydata() / points.get_ydata()[0], values / values[0], rtol=1e-13)
    loads = load[curve.resolved]
    np.testing.assert_allclose(points.get_xdata() / points.get_xdata()[0], loads / loads[0], rtol=1e-13)


def test_a_curve_refuses_other_quantities_and_laws_of_them(curve):
    with pytest.raises(
        ValueError, match=r"one of stiffness, .*, mean_gap, hydraulic_gap, transmissivity, not 'spots'"
    ):
        curve.plot(quantity="spots")
    with pytest.raises(ValueError, match="law applies only to the stiffness: leave it out with 'depth'"):
        curve.plot(quantity="depth", law=fitted(curve))
    with pytest.raises(ValueError, match=r"quantity must be one of inter.*, not 'stiffness'"):
        rc.plot.areal_curve(curve, quantity="stiffness")


def test_a_curve_draws_laws_beside_it(curve, surface):
    law, theories = fitted(curve), rc.loading_laws(surface, MODULUS, ["persson"])
    labels = [line.get_label() for line in curve.plot(law=law, theories=theories).lines]
    assert any(f"{law.exponent:.3f}" in label for label in labels)
    assert theories[0].name in labels


class Page(HTMLParser):
    """The rows of the tables of a page, the source of its picture, and what is open at its end."""

    def __init__(self, text):
        super().__init__()
        self.rows, self.pictures, self.left = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        if tag == "tr":
            self.rows.append([])
        if tag == "img":
            self.pictures.append(dict(attrs)["src"])
        else:
            self.left.append(tag)

    def handle_endtag(self, tag):
        assert self.left.pop() == tag

    def handle_data(self, data):
        if self.left[-1] in ("td", "th"):
            self.rows[-1].append(data)


def shown(value):
    page = Page(value._repr_html_())
    assert page.left == []
    (picture,) = page.pictures
    kind, _, text = picture.partition(",")
    assert kind == "data:image/png;base64"
    assert base64.b64decode(text).startswith(b"\x89PNG")
    assert pyplot.get_fignums() == []
    return page.rows


def test_a_notebook_shows_a_surface(surface):
    rows = dict(shown(surface.with_heights(surface.heights, "<b>bold & brave</b>")))
    assert rows["size"] == "32 x 40 cells, 3.2 µm x 4 µm, free"
    assert rows["missing points"] == "none"
    assert rows["history"] == "<b>bold & brave</b>", "escaped, and read back"


def test_a_notebook_shows_a_solution(solution):
    rows = shown(solution)
    assert ["force", "1 mN"] in rows
    assert ["contact spots", str(solution.spots.count)] in rows
    notes = [row[1] for row in rows if row[0] == "note"]
    assert notes == list(solution.notes)


def test_a_notebook_shows_the_loads_of_a_curve(curve):
    """The first and the last of many, and what the grid does not resolve."""
    rows = shown(curve)
    (head,) = [row for row in rows if row[0].startswith("force")]
    loads = rows[rows.index(head) + 1 :]
    assert len(loads) == 31
    assert loads[15][0] == "..."
    factor = {"mN": 1e3, "µN": 1e6, "N": 1.0}[head[0].split("[")[1].rstrip("]")]
    kept = [float(row[0]) / factor for row in loads if row[0] != "..."]
    np.testing.assert_allclose(kept, np.r_[curve.force[:15], curve.force[-15:]], rtol=5e-4)  # four digits
    assert sum("not resolved" in row for row in loads[:15]) == np.count_nonzero(~curve.resolved[:15])


def test_a_notebook_shows_a_joint_against_pressure():
    grid = rc.Grid((16, 16), 1e-6, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(3))
    rows = shown(rc.loading_curve(surface, 1e9, pressures=[1e4, 1e5]))
    assert any(row[0] == "nominal pressure [kPa]" for row in rows)


@pytest.mark.parametrize("kind", ["ring", "line", "foundation"])
def test_a_notebook_shows_lines_and_rings(kind):
    body, operator = on_a_line(kind)
    solution = rc.press(body, MODULUS, depth=3e-10 if kind == "ring" else 1e-6, operator=operator)
    assert dict(shown(solution))["force"].endswith("N/m" if kind == "line" else "N")
    if kind != "ring":
        shown(body)


def test_a_notebook_shows_surfaces_that_stick():
    rings = rc.RadialGrid.uniform(40, radius=6e-7)
    ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    adhesion = rc.Adhesion(work=10e-3, range=4e-9)
    depths = [10e-9, 0.0, -20e-9]
    state = next(rc.adhesive_path(ball, 1e8, adhesion, depths=depths))
    facts = dict(shown(state))
    assert facts["depth"] == "10 nm"
    assert "Irwin's length" in facts
    loop = rc.adhesive_curve(ball, 1e8, adhesion, depths=depths)
    rows = shown(loop)
    assert facts["adhesion"] in [row[1] for row in rows if row[0] == "adhesion"]
    (head,) = [row for row in rows if row[0] == "branch"]
    branches = ["approach" if way else "retreat" for way in loop.approach]
    assert [row[0] for row in rows[rows.index(head) + 1 :]] == branches
    assert any(row[1].startswith("out at") for row in rows if len(row) == 2), "the pull-off"


def test_a_notebook_shows_a_detachment():
    rings = rc.RadialGrid.uniform(40, radius=6e-7)
    pressed = rc.press(rc.RadialProfile(-(rings.radii**2) / 2e-5, rings), 1e8, depth=10e-9)
    held, off = rc.detachment_path(pressed, 10e-3, depths=[5e-9, -20e-9])
    facts = dict(shown(held))
    assert facts["depth"] == "5 nm"
    assert facts["work of adhesion"] == "10 mJ/m²"
    assert "note" not in facts
    small = rc.detachment_curve(rc.press(pressed.problem.surface, 1e8, depth=2e-9), 10e-3)
    rows = shown(rc.detachment_curve(pressed, 10e-3, depths=[5e-9, -20e-9]))
    told = f"{quantity('pull_off_force', off.pull_off_force)} in tension at a depth of "
    assert ["pull-off force", told] in [[row[0], row[1].split("-")[0]] for row in rows]
    assert len(rows[-1]) == 6, "a table of the loads"
    assert [row[1] for row in shown(small) if row[0] == "note"] == list(small.notes)
    assert small.preload_too_small


def test_a_curve_becomes_a_table_with_a_row_a_load(curve):
    frame = curve.to_dataframe()
    assert list(frame.index) == list(range(len(curve)))
    assert frame.index.name == "load"
    for name in ("force", "stiffness", "contact_area", "mean_gap", "nominal_pressure", "spots", "resolved"):
        np.testing.assert_array_equal(frame[name], getattr(curve, name))
    assert set(frame["status"]) == {"converged"}
    assert set(frame.attrs["units"]) == set(frame.columns)
    assert frame.attrs["units"]["stiffness"] == "N m-1"
    assert "secant_stiffness" not in frame, "it belongs to pairs of loads"


def test_matplotlib_is_loaded_when_something_is_drawn_and_not_before():
    program = (
        "import sys, numpy as np, roughcontact as rc;"
        "surface = rc.Surface(np.eye(8), rc.Grid((8, 8), 1.0)); rc.plot;"
        "assert 'matplotlib' not in sys.modules;"
        "surface._repr_html_();"
        "assert 'matplotlib' in sys.modules and 'matplotlib.pyplot' not in sys.modules"
    )
    done = subprocess.run([sys.executable, "-c", program], check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
