"""Loading curves of adhesive surfaces: force against depth, with jumps."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughcontact.adhesion.adhesive_curve import AdhesiveCurve
from roughcontact.labels.engineering_units import scale, written
from roughcontact.labels.variables import VARIABLES, unit_of
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.ticks import LABEL, TICK, label_axes

__all__ = ["jump_area", "jump_figure", "jump_loop", "pieces_of"]

_STYLES: dict[bool, Any] = {
    True: {"color": "#0072b2", "marker": "o", "label": "approach"},
    False: {"color": "#d55e00", "marker": "v", "markerfacecolor": "none", "label": "retreat"},
}
_JUMP: Any = {"color": "0.2", "linestyle": (0, (3, 2)), "linewidth": 1.0}
_SEEN = 0.05  # of the width or height of the picture: smallest jump with its energy written beside it
_OFF = 0.08  # of the width of the picture: length of the line of a body that is pulled off


def jump_loop(loop: AdhesiveCurve, ax: Axes | None = None) -> Axes:
    """Draw force against depth on approach and retreat; jumps are dashed, large jumps with their lost energy.

    Parameters
    ----------
    loop : AdhesiveCurve
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> loop = rc.adhesive_loop(ball, 1e8, rc.Adhesion(work=10e-3, range=2.5e-9), depth=10e-9)
    >>> axes = rc.plot.jump_loop(loop)
    >>> axes.get_title(), [text.get_text() for text in axes.texts]
    ('pull-off 499 nN, 478 aJ lost in 7 jumps', ['307 aJ', '170 aJ'])
    """
    axes, kind = axes_for(ax), loop.geometry
    finite = np.isfinite(loop.depth)
    x = scale(float(np.abs(loop.depth[finite]).max(initial=0.0)), VARIABLES["depth"].unit)
    y = scale(float(np.abs(loop.force).max()), unit_of("force", kind))
    axes.axhline(0.0, color="0.75", linewidth=0.8, zorder=0)
    for way, style in _STYLES.items():
        for depth, force in pieces_of(loop, way):
            axes.plot(depth * x.factor, force * y.factor, linewidth=1.1, color=style["color"])
        points = (loop.approach == way) & finite
        if points.any():
            axes.plot(
                loop.depth[points] * x.factor,
                loop.force[points] * y.factor,
                linestyle="none",
                markersize=3.5,
                **style,
            )
    spans = np.array([np.ptp(loop.depth[finite]), np.ptp(loop.force)])
    for jump in loop.jumps:
        off = np.isnan(jump.depth_after)
        start = np.array([jump.depth, jump.force_before])
        end = start - (_OFF * spans[0], 0.0) if off else np.array([jump.depth_after, jump.force_after])
        ends = np.array([start, end]) * (x.factor, y.factor)
        axes.plot(*ends.T, **_JUMP, label="jump" if jump is loop.jumps[0] else None)
        if off or (np.abs(end - start) > _SEEN * spans).any():
            words = "pulled off" if off else written(jump.lost, unit_of("jump_lost", kind))
            side = (4, "left") if jump.approach else (-4, "right")
            place: Any = {"xytext": (side[0], 4), "ha": side[1], "textcoords": "offset points"}
            axes.annotate(words, ends.mean(axis=0), fontsize=TICK - 1, **place)
    if (at := loop.pull_off_point) is not None:
        depth, force = loop.lowest_force_depth[at] * x.factor, loop.lowest_force[at] * y.factor
        axes.plot([depth], [force], "kx", label="pull-off" if _is_off(loop) else "largest tension")
    axes.set_title(loop_words(loop), fontsize=LABEL)
    label_axes(axes, f"depth [{x.unit}]", f"force [{y.unit}]", grid=True)
    axes.legend(fontsize=TICK, frameon=False)
    return axes


def jump_area(loop: AdhesiveCurve, ax: Axes | None = None) -> Axes:
    """Draw the relative contact area against the depth on approach and retreat.

    Parameters
    ----------
    loop : AdhesiveCurve
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> loop = rc.adhesive_loop(ball, 1e8, rc.Adhesion(work=10e-3, range=4e-9), depth=10e-9)
    >>> rc.plot.jump_area(loop).get_ylabel()
    'relative real contact area A/A0 [%]'
    """
    axes, finite = axes_for(ax), np.isfinite(loop.depth)
    x = scale(float(np.abs(loop.depth[finite]).max(initial=0.0)), VARIABLES["depth"].unit)
    for way, style in _STYLES.items():
        along = loop.approach == way
        line = np.flatnonzero(
            (along | np.append(along[1:], False)) & finite
        )  # from the turning point of the path
        if along[line].any():
            # No line crosses a jump, or connects two branches of the same direction.
            broken = np.flatnonzero(np.isin(line, loop.jumped) | (np.diff(line, prepend=line[0]) > 1))
            depth, area = (
                np.insert(values[line], broken, np.nan) for values in (loop.depth, loop.contact_fraction)
            )
            axes.plot(depth * x.factor, 100 * area, linewidth=1.0, markersize=3.5, **style)
    label_axes(axes, f"depth [{x.unit}]", f"{VARIABLES['contact_fraction'].label} [%]", grid=True)
    axes.legend(fontsize=TICK, frameon=False)
    return axes


def jump_figure(loop: AdhesiveCurve) -> Figure:
    """Return force and contact area against depth, side by side.

    Parameters
    ----------
    loop : AdhesiveCurve

    Returns
    -------
    Figure

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> loop = rc.adhesive_loop(ball, 1e8, rc.Adhesion(work=10e-3, range=4e-9), depth=10e-9)
    >>> [axes.get_ylabel() for axes in rc.plot.jump_figure(loop).axes]
    ['force [nN]', 'relative real contact area A/A0 [%]']
    """
    figure = Figure(figsize=(9.6, 4.2), layout="constrained")
    first, second = figure.subplots(1, 2)
    jump_loop(loop, first)
    jump_area(loop, second)
    return figure


def loop_words(loop: AdhesiveCurve) -> str:
    """Return pull-off force, lost energy and number of jumps in words."""
    words = []
    if not loop.approach.all():
        end = "pull-off" if _is_off(loop) else "tension up to"
        words.append(f"{end} {written(loop.pull_off_force, unit_of('force', loop.geometry))}")
    if loop.jumps:
        lost = [jump.lost for jump in loop.jumps if np.isfinite(jump.lost)]
        count = f"{len(lost)} jump{'s' if len(lost) != 1 else ''}"
        off = ", then pulled off" if len(lost) < len(loop.jumps) else ""
        words.append(f"{written(sum(lost), unit_of('jump_lost', loop.geometry))} lost in {count}{off}")
    else:
        words.append("no jump")
    return ", ".join(words) + (" (unresolved)" if loop.unresolved else "")


def _is_off(loop: AdhesiveCurve) -> bool:
    return bool(loop.contact_area[-1] == 0)


def pieces_of(loop: AdhesiveCurve, way: bool) -> list[tuple[Any, Any]]:
    """Return the pieces of a path between its jumps in one direction, as depths and forces, with the pull-off."""
    pieces: list[list[tuple[float, float]]] = [[]]
    last: tuple[float, float] | None = None
    for k, here in enumerate(zip(loop.depth, loop.force, strict=True)):
        if loop.approach[k] != way:
            pieces.append([])
        else:
            if not pieces[-1] and last is not None:
                pieces[-1].append(last)  # the turning point of the path
            pull_off = (
                [(loop.lowest_force_depth[k], loop.lowest_force[k])] if k == loop.pull_off_point else []
            )
            for jump in (jump for jump, at in zip(loop.jumps, loop.jumped, strict=True) if at == k):
                while pull_off and pull_off[0][0] >= jump.depth:
                    pieces[-1].append(pull_off.pop())
                pieces[-1].append((jump.depth, jump.force_before))
                pieces.append([(jump.depth_after, jump.force_after)])
            pieces[-1] += [*pull_off, here]
        last = here
    arrays = [np.array([point for point in piece if np.isfinite(point).all()]) for piece in pieces]
    return [(piece[:, 0], piece[:, 1]) for piece in arrays if len(piece) > 1]
