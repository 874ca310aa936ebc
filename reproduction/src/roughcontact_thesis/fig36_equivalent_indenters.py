"""Figure 36: a parabola, the indenter that stands for roughness, and both added."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from roughcontact.mdr.bodies import indenter
from roughcontact.mdr.bodies.axisymmetric_profile import Profile
from roughcontact.mdr.bodies.indentation import indentation_curve
from roughcontact.theory.spheres_and_punches import rough_sphere
from roughcontact.theory.stiffness_laws import pohrt_popov
from roughcontact_thesis import drawing
from roughcontact_thesis.ruling import exactly
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["Indenters", "case", "draw", "verdicts"]

TITLE = "a parabola, the indenter that is pressed in like roughness of H = 0.7, and their sum"
HURST = 0.7
RADIUS = 0.5
LENGTH = 1.0
RMS = 9e-3
SHOWN = 0.1  # radius up to which the shapes are drawn, over the length
FORCES = np.geomspace(1e-7, 1e-2, 60)  # over E* L^2
SEED = 0
CHOSEN = (
    f"R = {RADIUS:g} L and rms height {RMS:g} L as in figure 37, zeta = 1.7/(H + 1) = {1.7 / (HURST + 1):g}",
    f"drawn up to r = {SHOWN:g} L, heights enlarged",
)
SIZE = (drawing.PAGE, 2.6)


class Indenters(NamedTuple):
    """The three bodies of revolution."""

    parabola: Profile
    roughness: Profile
    both: Profile


def case(seed: int = SEED) -> Indenters:
    """Return the three indenters; nothing is random, the seed is not used."""
    parabola = indenter.paraboloid(RADIUS)
    roughness = indenter.equivalent_roughness(HURST, rms=RMS, length=LENGTH)
    return Indenters(parabola, roughness, parabola + roughness)


def draw(figure: Figure, data: Indenters) -> None:
    """Draw cuts through the parabola (a), the indenter of eq. 5.6 (b) and their sum (c), to one scale."""
    panels = figure.subplots(1, 3, sharex=True, sharey=True)
    r = SHOWN * LENGTH * np.linspace(0, 1, 401) ** 2  # close to the tip, where the slope has no bound
    x = np.concatenate([-r[:0:-1], r])
    top = float(data.both.height(r[-1:])[0]) * 1.12
    names = "(a)  $z_p = r^2/2R$", f"(b)  $z_s = Q\\,r^{{{HURST:g}}}$", "(c)  $z_c = z_p + z_s$"
    for axes, profile, name in zip(panels, data, names, strict=True):
        z = profile.height(np.abs(x))
        axes.fill_between(x, z, top, color="#cfe3f2", linewidth=0)
        axes.plot(x, z, color=drawing.COLOURS[0], linewidth=1.4)
        axes.set_title(name, loc="center")
        axes.set_xlabel(r"$x\,/\,L$")
        axes.axhline(0, color="0.6", linewidth=0.8, zorder=0)
    panels[0].set(xticks=[-0.5 * SHOWN, 0, 0.5 * SHOWN], ylabel=r"$z\,/\,L$")
    panels[0].set(xlim=(x[0], x[-1]), ylim=(-0.06 * top, top))


def verdicts(data: Indenters) -> Verdicts:
    """Return whether the indenters have the stiffness that eqs 5.5 and 5.9 give them."""
    _, rough, both = (indentation_curve(each, 1.0, forces=FORCES * LENGTH**2) for each in data)
    law = pohrt_popov.stiffness(rough.force, HURST, RMS, LENGTH, 1.0)
    force = rough_sphere.force(
        both.stiffness, radius=RADIUS, hurst=HURST, rms=RMS, length=LENGTH, modulus=1.0
    )
    off_law = float(np.abs(rough.stiffness / law - 1).max())
    off_force = float(np.abs(force / both.force - 1).max())
    yield Verdict(
        "the indenter Q r^H is as stiff as the rough surface it stands for",
        "a rotationally symmetric indenter with power H has the same indentation behavior as a fractal rough surface",
        "section 5.2, eqs 5.5, 5.6",
        f"within {max(off_law, 1e-15):.0e} of eq. 5.5, with kappa(H) as Sneddon's integral gives it: the thesis does "
        "not say",
        exactly(bool(off_law < 1e-10), "rounding"),
        "method",
    )
    yield Verdict(
        "force and stiffness of the sum of parabola and indenter",
        "the dependence between normal force and normal contact stiffness can again be found using the solution by "
        "[20],[78]",
        "section 5.2, eq. 5.9 with E* for E",
        f"within {max(off_force, 1e-15):.0e} of the indentation of the profile",
        exactly(bool(off_force < 1e-10), "rounding"),
        "method",
    )
