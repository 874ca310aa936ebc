"""The law of an interface for finite and discrete elements: pressure and stiffness against gap, per area."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from roughcontact import methods
from roughcontact.contact.curve import REMEDY, Curve
from roughcontact.errors import InputError, placed
from roughcontact.evaluation.conduction import conductance
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.contact_columns import TANGENTIAL
from roughcontact.materials import Elastic, as_modulus, reduced_shear_modulus
from roughcontact.validation import Array, numeric, positive

__all__ = ["InterfaceTable", "interface_table"]

_FLOW = ("hydraulic_gap", "flow_factor")
_CONDUCTANCES = ("thermal_conductance_per_area", "electrical_conductance_per_area")
_PARTS = ("spots_conductance_per_area", "joint_conductance_per_area")
_SAME = 1e-6  # relative difference below which two reduced moduli are equal


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class InterfaceTable:
    """The law of an interface per nominal area: the resolved loads of a curve, by rising pressure.

    It does not contain the compliance of the bodies, which the model around the interface has.

    Attributes
    ----------
    pressure, gap, stiffness, contact_fraction : array, shape (n,)
        Nominal pressure p [Pa], mean gap g [m], K/A0 [Pa/m], relative real contact area A/A0.
    conductances : dict of array
        ``thermal_conductance_per_area`` (h_c) [W/(m^2 K)] and ``electrical_conductance_per_area`` [S/m^2], if known.
        For a curve with `ConductanceParts`, h_c is replaced by ``spots_conductance_per_area`` and by
        ``joint_conductance_per_area``, which includes gas and radiation.
    flow : dict of array
        ``hydraulic_gap`` [m] and ``flow_factor``, if the curve has the measure `Transmissivity`.
    tangential : dict of array
        ``tangential_stiffness_per_area`` K_t/A0 [Pa/m] if the bodies are known: K/A0 over E*/G*.
    friction : float, optional
        Coefficient of friction [-].
    area : float
        Nominal area of a table of forces [m^2].
    periodic : bool
        Whether the map was pressed as a part of an infinite surface.
    hardness : float
        Pressure that no cell exceeds [Pa].

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1), long_cutoff=3e-5)
    >>> table = rc.interface_table(rc.loading_curve(surface, 1e9, pressures=np.geomspace(1e6, 1e7, 6)))
    >>> f"closed by {table.overclosure[0] * 1e9:.0f} to {table.overclosure[-1] * 1e9:.0f} nm"
    'closed by 55 to 179 nm'
    >>> f"straight lines lie up to {table.chord_error:.1%} above", table.to_dataset()["mean_gap"].attrs["units"]
    ('straight lines lie up to 2.7% above', 'm')
    """

    pressure: Array
    gap: Array
    stiffness: Array
    contact_fraction: Array
    conductances: dict[str, Array]
    flow: dict[str, Array]
    area: float
    periodic: bool
    hardness: float = math.inf
    tangential: dict[str, Array] = field(default_factory=dict)
    friction: float | None = None

    def __len__(self) -> int:
        return len(self.pressure)

    @property
    def validity(self) -> tuple[float, float]:
        """Lowest and highest nominal pressure that the curve resolves [Pa]."""
        return float(self.pressure[0]), float(self.pressure[-1])

    @property
    def middle_pressure(self) -> float:
        """Geometric mean of the lowest and the highest nominal pressure [Pa]."""
        return math.sqrt(math.prod(self.validity))

    @property
    def zero_gap(self) -> float:
        """Mean gap at which the pressure begins [m]: the tangent of the first resolved load ends there.

        The pressure of a rough surface falls without end as the gap grows. Finite-element codes need such a gap, and a
        straight line from there to the first resolved load, with the stiffness of that load.
        """
        return float(self.gap[0] + self.pressure[0] / self.stiffness[0])

    @property
    def overclosure(self) -> Array:
        """Closure of the interface since `zero_gap` [m], shape (n,)."""
        return self.zero_gap - self.gap

    @property
    def chord_error(self) -> float:
        """Largest relative distance of straight lines between the loads above the pressure.

        It is that of an exponential law, (r - 1)/ln r exp(ln r/(r - 1) - 1) - 1 between pressures of the ratio r. The
        law of a rough surface is nearly exponential.
        """
        ratio = float((self.pressure[1:] / self.pressure[:-1]).max())
        return math.expm1(math.log((ratio - 1) / math.log(ratio)) + math.log(ratio) / (ratio - 1) - 1)

    to_csv = methods.csv_of
    to_dataset = methods.interface_dataset


@numeric(resistivities="ohm*m", conductivities="W/m/K", area="m^2")
def interface_table(
    curve: Curve,
    *,
    resistivities: tuple[float, float] | None = None,
    conductivities: tuple[float, float] | None = None,
    area: float | None = None,
    bodies: Elastic | tuple[Elastic, ...] | None = None,
    friction: float | None = None,
) -> InterfaceTable:
    """Return pressure, stiffness and area against gap, per nominal area: the law of an interface.

    For finite elements and discrete elements: `roughcontact.write` writes it as a table of comma-separated values
    (``.csv``, also for MOOSE) or as text (``.txt``), as lines for Abaqus or CalculiX (``.inp``), or as a table of
    forces for LAMMPS (``.table``).

    Parameters
    ----------
    curve : Curve
        The curve of a map, best of a periodic one; loads that are not resolved are left out of the table.
    resistivities, conductivities : tuple of float, optional
        Values of both bodies [ohm m] and [W/(m K)], for the conductances per area; see `conductance`.
    area : float, optional
        Nominal area of the forces for LAMMPS [m^2], such as that of one particle; by default that of the map.
    bodies : Solid, Material or str, or a tuple of two, optional
        The bodies of the curve, for the tangential stiffness per area without slip, K/A0 over E*/G*
        (`theory.mindlin`); a single one touches a rigid body.
    friction : float, optional
        Coefficient of friction [-], for Abaqus and CalculiX; needs `bodies`.

    Returns
    -------
    InterfaceTable
        The resolved loads, by rising pressure.

    Raises
    ------
    ValueError
        If the curve is not that of a map, fewer than two of its loads are resolved, or the gap does not fall from load
        to load; if the bodies have another reduced modulus than the curve, or `friction` is given without them.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1), long_cutoff=3e-5)
    >>> curve = rc.loading_curve(surface, 1e11, pressures=[3e7, 1e8, 3e8])
    >>> table = rc.interface_table(curve)
    >>> len(table), bool((np.diff(table.overclosure) > 0).all())
    (3, True)
    >>> rubber = rc.Solid(1e7, 0.5)
    >>> soft = rc.loading_curve(surface, rubber, pressures=[4e3, 1.3e4, 4e4])
    >>> table = rc.interface_table(soft, bodies=rubber, friction=0.8)
    >>> (table.stiffness / table.tangential["tangential_stiffness_per_area"]).round(6).tolist()
    [1.5, 1.5, 1.5]
    """
    if curve.geometry is not Geometry.SURFACE:
        raise InputError(
            f"the law of an interface per area needs the curve of a map, not of a {curve.geometry.value}",
            "press a map of heights",
        )
    resolved = curve.resolved & np.isfinite(curve.interfacial_stiffness) & (curve.force > 0)
    kept = np.flatnonzero(resolved)[np.argsort(curve.force[resolved], kind="stable")]
    if len(kept) < 2:
        raise InputError(f"a table needs two resolved loads, and the curve has {len(kept)}", REMEDY)
    gap = curve.mean_gap[kept]
    if not ((np.diff(gap) < 0).all() and (np.diff(curve.force[kept]) > 0).all()):
        raise InputError(
            "the gap does not fall from each resolved load to the next", "use loads that are further apart"
        )
    stiffness = curve.interfacial_stiffness_per_area[kept]
    tangential = {} if bodies is None else {TANGENTIAL.name: stiffness / _moduli_ratio(curve, bodies)}
    if friction is not None and bodies is None:
        raise InputError(
            "`friction` is given without the bodies, and E* does not determine how they shear",
            "give `bodies` too, such as ('steel', 'aluminium')",
            "bodies",
        )
    found: dict[str, Array] = {}
    if resistivities is not None or conductivities is not None:
        found = conductance(curve, resistivities=resistivities, conductivities=conductivities)
    names: tuple[str, ...] = _CONDUCTANCES
    if _PARTS[1] in curve.measured:
        found, names = found | dict(curve.measured), (*_PARTS, _CONDUCTANCES[1])
    return InterfaceTable(
        pressure=curve.nominal_pressure[kept],
        gap=gap,
        stiffness=stiffness,
        contact_fraction=curve.contact_fraction[kept],
        conductances={name: found[name][kept] for name in names if name in found},
        flow={name: curve.measured[name][kept] for name in _FLOW if name in curve.measured},
        area=curve.nominal_area if area is None else float(positive(area, "area [m^2]")),
        periodic=all(curve.periodic),
        hardness=curve.hardness,
        tangential=tangential,
        friction=None if friction is None else float(positive(friction, "friction")),
    )


def _moduli_ratio(curve: Curve, bodies: Elastic | tuple[Elastic, ...]) -> float:
    """Return E*/G* of the bodies of a curve.

    Raises
    ------
    ValueError
        If the bodies are not those of the curve.
    """
    with placed("bodies"):
        modulus = as_modulus(bodies)
        ratio = modulus / reduced_shear_modulus(*(bodies if isinstance(bodies, tuple) else (bodies,)))
        if not math.isclose(modulus, curve.modulus, rel_tol=_SAME):
            raise InputError(
                f"these bodies have a reduced modulus of {modulus:.6g} Pa, but the curve has {curve.modulus:.6g} Pa",
                "give the bodies of the curve",
            )
    return ratio
