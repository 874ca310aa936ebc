"""A case: a rough surface that is pressed, then pulled tangentially until it slides."""

from __future__ import annotations

import numpy as np
from pydantic import Field

from roughcontact.contact.loading import loading_path
from roughcontact.contact.solution import Solution
from roughcontact.contact.stiffness import cell_stiffness
from roughcontact.friction.slip_curve import SlipCurve, slide_curve
from roughcontact.friction.tangential_stiffness import tangential_stiffness
from roughcontact.labels.labelled import described, variable
from roughcontact.material import Solid
from roughcontact.solver.control import Status
from roughcontact.study.case import Case, Record
from roughcontact.study.cases.shared_parameters import ForceRange, RoughSquare

__all__ = ["CASE", "SlipParameters", "run"]

_SIDEWAYS = "tangential stiffness of the contact region"
_LIMIT = 1e-5  # of the unit displacement; the error of the stiffness is about its square


class SlipParameters(RoughSquare, ForceRange):
    """A rough contact of two equal bodies under increasing normal forces; at each force it is pulled along x from rest.

    Parameters
    ----------
    points, size, hurst, rms, rms_band, rolloff, long_cutoff, short_cutoff, amplitudes, periodic, radius, modulus
        See `RoughSquare`.
    poisson_ratio : float
        Poisson's ratio nu of both bodies. Normal and tangential displacements are independent because both are equal.
    friction : float
        Coefficient of friction mu.
    lowest_force, highest_force, loads
        Normal forces, see `ForceRange`.
    pulls : int
        Number of tangential forces at each normal force, in equal steps from rest to mu F, where the bodies slide.
    tolerance : float
        Tolerance of the certificates of pressure and traction.
    """

    poisson_ratio: float = Field(default=0.3, gt=-1, le=0.5)
    friction: float = Field(default=0.3, gt=0)
    lowest_force: float = Field(default=3e-3, gt=0)
    highest_force: float = Field(default=0.3, gt=0)
    loads: int = Field(default=9, ge=2)
    pulls: int = Field(default=10, ge=1)
    tolerance: float = Field(default=1e-6, gt=0, le=1e-2)

    @property
    def bodies(self) -> tuple[Solid, Solid]:
        """The two equal solids with this reduced modulus."""
        one = Solid(2 * self.modulus * (1 - self.poisson_ratio**2), self.poisson_ratio)
        return one, one


def run(parameters: SlipParameters, rng: np.random.Generator) -> Record:
    """Return normal and tangential stiffness, and the path to gross slip, of one sample.

    Returns
    -------
    xarray.Dataset
        Along ``load``, the normal forces: ``force``, ``depth``, ``stiffness``, ``contact_area``,
        ``dimensionless_force`` F/(E* h L), ``dimensionless_stiffness`` k/(E* L); ``tangential_stiffness`` of the
        whole contact region without slip, the mean over all directions, and along ``principal`` its smaller and
        larger principal value. Along ``load`` and ``pull``: ``tangential_displacement`` along x and ``stick_area``,
        at the parts ``pulled`` of mu F; the last displacement is the largest before gross slip. Without a dimension
        ``cell_stiffness``.
    """
    import xarray

    surface = parameters.on_body(parameters.roughness(rng))
    bodies, forces = parameters.bodies, parameters.forces
    scale = parameters.modulus * parameters.size
    pulled = np.arange(1, parameters.pulls + 1) / parameters.pulls
    path = loading_path(
        surface, bodies, forces=forces * (scale * parameters.rms), tolerance=parameters.tolerance
    )
    points: list[Solution] = []
    pulls: list[SlipCurve] = []
    principals = []
    for pressed in path:
        points.append(pressed)
        principals.append(
            tangential_stiffness(pressed.contact, parameters.grid, bodies, tolerance=_LIMIT).principal[0]
        )
        pulls.append(
            slide_curve(
                pressed,
                bodies,
                friction=parameters.friction,
                forces=pulled * (parameters.friction * pressed.force),
                tolerance=parameters.tolerance,
            )
        )
    stiffness = np.array([each.stiffness for each in points])
    sideways = np.array(principals)
    normal = {
        name: variable(name, ("load",), [getattr(each, name) for each in points])
        for name in ("force", "depth", "stiffness", "contact_area")
    }
    record = xarray.Dataset(
        normal
        | {
            "dimensionless_force": variable("dimensionless_force", ("load",), forces),
            "dimensionless_stiffness": variable("dimensionless_stiffness", ("load",), stiffness / scale),
            "tangential_stiffness": described(
                "load", sideways.mean(axis=1), f"{_SIDEWAYS}, mean over directions", "N m-1"
            ),
            "principal_stiffness": described(
                ("load", "principal"), sideways, f"{_SIDEWAYS} along its two axes", "N m-1"
            ),
            "pulled": described("pull", pulled, "tangential force over mu F"),
            "tangential_displacement": variable(
                "tangential_displacement", ("load", "pull"), [each.displacement[:, 0] for each in pulls]
            ),
            "stick_area": variable("stick_area", ("load", "pull"), [each.stick_area for each in pulls]),
            "residual": variable(
                "residual", ("load",), [_worst(*pair) for pair in zip(points, pulls, strict=True)]
            ),
            "status": variable(
                "status", ("load",), [_ended(*pair).value for pair in zip(points, pulls, strict=True)]
            ),
            "cell_stiffness": variable("cell_stiffness", (), cell_stiffness(points[0].problem.operator)),
        }
    )
    return record.assign_attrs(title="rough contacts pulled sideways until they slide")


def _worst(pressed: Solution, pulled: SlipCurve) -> float:
    return max(pressed.residual, float(pulled.residual.max()))


def _ended(pressed: Solution, pulled: SlipCurve) -> Status:
    """Return the status of a load: converged if the pressure and all tractions are."""
    return next((each for each in (pressed.status, *pulled.status) if not each.converged), pressed.status)


CASE = Case("slip", 2, SlipParameters, run)
