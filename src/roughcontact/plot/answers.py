"""The ``plot`` methods of surfaces and solutions: each draws a suitable picture."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from matplotlib.axes import Axes

from roughcontact.adhesion.adhesive_state import AdhesiveState
from roughcontact.adhesion.detachment_state import DetachmentState
from roughcontact.contact.compare import Law
from roughcontact.contact.curve import Curve
from roughcontact.contact.loop import Loop
from roughcontact.contact.solution import Solution
from roughcontact.errors import about
from roughcontact.evaluation.contact_flux import ContactFlux
from roughcontact.fluid.gap_flow import GapFlow
from roughcontact.plot import curves, loops, maps, profile_plot
from roughcontact.plot.flows import flux_plot
from roughcontact.plot.flows.gap_flow_map import flow_map
from roughcontact.plot.flows.leak_plot import LEAKS, leak_curve
from roughcontact.plot.tension import tension_map, tension_profile
from roughcontact.statistics.power_law import PowerLaw
from roughcontact.surface.preparation.spikes import Spikes
from roughcontact.surface.surface import Surface

__all__ = ["plot_curve", "plot_flow", "plot_flux", "plot_loop", "plot_solution", "plot_state", "plot_surface"]


def plot_surface(surface: Surface, ax: Axes | None = None, *, spikes: Spikes | None = None) -> Axes:
    """Draw the heights: a map in colour, or a curve for a profile.

    Parameters
    ----------
    surface : Surface
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    spikes : Spikes, optional
        Spikes to mark, such as ``roughcontact.find_spikes(surface)``.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    >>> surface.plot(spikes=rc.find_spikes(surface)).get_xlabel()
    'x [µm]'
    """
    draw = maps.height_map if surface.grid.ndim == 2 else profile_plot.profile_curve
    return draw(surface, ax, spikes=spikes)


def plot_solution(
    solution: Solution, ax: Axes | None = None, *, field: Literal["pressure", "contact"] = "pressure"
) -> Axes:
    """Draw the pressure, or the cells in contact over the heights: maps, or curves for a line and for rings.

    Parameters
    ----------
    solution : Solution
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    field : {"pressure", "contact"}

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the field is unknown.

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4), 1e9, force=1e-3)
    >>> solution.plot(field="contact").get_xlabel()
    'x [µm]'
    """
    if field not in ("pressure", "contact"):
        raise about("field", f"must be 'pressure' or 'contact', not {field!r}")
    if solution.problem.grid.ndim == 1:
        one = {"pressure": profile_plot.pressure_profile, "contact": profile_plot.contact_profile}
        return one[field](solution, ax)
    return maps.pressure_map(solution, ax) if field == "pressure" else maps.contact_map(solution, ax)


def plot_flow(flow: GapFlow, ax: Axes | None = None, *, direction: int = 0) -> Axes:
    """Draw the gap with the contact, flow lines, and the critical constriction.

    Parameters
    ----------
    flow : GapFlow
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    direction : int
        Axis of the mean drop on a periodic map; 0 otherwise.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> rc.gap_flow(rc.press(surface, 1e9, pressure=2e6)).plot(direction=1).get_xlabel()
    'x [µm]'
    """
    return flow_map(flow, ax, direction=direction)


def plot_curve(
    curve: Curve,
    ax: Axes | None = None,
    *,
    quantity: str = "stiffness",
    law: PowerLaw | None = None,
    theories: Sequence[Law] = (),
) -> Axes:
    """Draw a quantity against load, both logarithmic; points that the grid does not resolve are open.

    Parameters
    ----------
    curve : Curve
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    quantity : str
        ``"stiffness"``, ``"contact_area"`` or ``"depth"`` against force; ``"interfacial_stiffness_per_area"``,
        ``"contact_fraction"``, ``"mean_gap"``, and with the measure `roughcontact.Transmissivity` ``"hydraulic_gap"``
        or ``"transmissivity"``, against nominal pressure.
    law : PowerLaw, optional
        A law to draw with a stiffness, such as ``curve.fit()``.
    theories : sequence of Law, optional
        Theories to draw, such as those of `roughcontact.loading_laws`.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the quantity is unknown, or a law is given with a quantity other than a stiffness.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    >>> curve = rc.loading_curve(surface, 1e9, forces=np.geomspace(1e-4, 1e-2, 9))
    >>> axes = curve.plot(quantity="contact_area", theories=rc.loading_laws(surface, 1e9, "persson"))
    >>> axes.get_xscale(), axes.get_ylabel()
    ('log', 'contact area [µm²]')
    """
    if law is not None and "stiffness" not in quantity:
        raise about("law", "applies only to the stiffness", f"leave it out with {quantity!r}")
    if quantity not in (every := (*curves.OF_FORCE, *curves.PER_AREA, *LEAKS)):
        raise about("quantity", f"must be one of {', '.join(every)}, not {quantity!r}")
    if quantity in LEAKS:
        return leak_curve(curve, ax, quantity=quantity)
    draw = curves.force_curve if quantity in curves.OF_FORCE else curves.areal_curve
    return draw(curve, ax, quantity=quantity, law=law, theories=theories)


def plot_flux(
    flux: ContactFlux,
    ax: Axes | None = None,
    *,
    field: Literal["share", "density", "resistance"] = "share",
) -> Axes:
    """Draw the share of each spot, the density of each cell, or the resistances of the spots against their areas.

    Parameters
    ----------
    flux : ContactFlux
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    field : {"share", "density", "resistance"}

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the field is unknown.

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4), 1e9, force=1e-3)
    >>> flux = rc.contact_flux(solution, resistivities=(1.7e-8, 1.7e-8))
    >>> [flux.plot(field=each).get_xlabel() for each in ("share", "density", "resistance")]
    ['x [µm]', 'x [µm]', 'area of a contact spot [µm²]']
    """
    if field == "resistance":
        return flux_plot.spot_resistances(flux, ax)
    if field not in ("share", "density"):
        raise about("field", f"must be 'share', 'density' or 'resistance', not {field!r}")
    return flux_plot.flux_map(flux, ax, field=field)


def plot_loop(
    loop: Loop, ax: Axes | None = None, *, quantity: Literal["depth", "stiffness", "bearing"] = "depth"
) -> Axes:
    """Draw the three branches of a loop, or the surface before and after it.

    Parameters
    ----------
    loop : Loop
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    quantity : {"depth", "stiffness", "bearing"}
        Force against depth; the stiffness per area K/A0 against nominal pressure, both logarithmic; or the bearing
        (Abbott) curve before and after.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the quantity is unknown.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> loop = rc.loading_loop(ball, 1e11, hardness=2e9, forces=[0.05, 0.1, 0.2])
    >>> [loop.plot(quantity=each).get_xlabel() for each in ("depth", "stiffness", "bearing")]
    ['depth [nm]', 'nominal pressure [MPa]', 'area above the height [%]']
    """
    if quantity == "bearing":
        return loops.bearing_curves(loop.surface, loop.flow, ax)
    draw = {"depth": loops.depth_loop, "stiffness": loops.stiffness_loop}
    if quantity not in draw:
        raise about("quantity", f"must be one of {', '.join((*draw, 'bearing'))}, not {quantity!r}")
    return draw[quantity](loop, ax)


def plot_state(state: AdhesiveState | DetachmentState, ax: Axes | None = None) -> Axes:
    """Draw the pressure of adhesive surfaces, tension in blue, contact outlined; for a line or rings, a curve.

    Parameters
    ----------
    state : AdhesiveState or DetachmentState
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 2e-8), radius=1e-5)
    >>> state = rc.adhesive_state(ball, 1e8, rc.Adhesion(work=10e-3, range=4e-9), depth=2e-9)
    >>> state.plot().get_xlabel()
    'x [nm]'
    """
    return tension_map(state, ax) if state.contact.ndim == 2 else tension_profile(state, ax)
