"""A whole joint: the law of its interface per area, summed over the pressure on its face.

Each cell of the face has the law of the interface at its own nominal pressure, with K(p) the interfacial stiffness per
area and C = E*/G* (``r`` is the place in the face, c the centre of stiffness):

    normal      int K dA                       centre   int K r dA / int K dA
    tilting     int K (r - c)(r - c) dA        shear    int K/C dA
    torsion     int (K/C) |r - c|^2 dA         slip     Q(s) = int tau(s; p) dA

The pressure must change little over the longest wave of the roughness. The compliance of the bodies is not included.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from scipy.ndimage import maximum_filter, minimum_filter

from roughcontact import methods
from roughcontact.cached import cached_property
from roughcontact.errors import InputError, about
from roughcontact.evaluation.conduction import Conductors
from roughcontact.guesses import hinted
from roughcontact.joints.normal_law import NormalLaw
from roughcontact.joints.pressure_field import PressureField
from roughcontact.joints.shear_law import ShearLaw
from roughcontact.labels.engineering_units import written
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.validation import Array, Mask, numeric, positive, positive_scalar, require, shown

__all__ = ["Joint", "joint"]

Law: TypeAlias = NormalLaw | ShearLaw

WAVES = 3  # longest waves over which the pressure may change by its own value
_ALIKE = 0.01  # relative difference of pressures that are summed together: an error of its square
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(64)


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class Joint:
    """The stiffness of a joint: the laws of its patches under a pressure field.

    Numbers are means over the laws of the patches; `standard_error` gives their errors.

    Attributes
    ----------
    field : PressureField
    normal, shear : tuple
        The laws of each patch, of `NormalLaw` and of `ShearLaw`; the latter empty without friction.
    longest_wave : float
        Length of the longest waves of the roughness [m]; NaN if it is not known.

    Examples
    --------
    >>> import roughcontact as rc
    >>> steel = rc.handbook("steel")
    >>> field = rc.bolt_pressure(force=17e3, head=13e-3, hole=9e-3, thickness=10e-3)
    >>> curve = rc.loading_curve(rc.examples.surface("ground"), (steel, steel), pressures=field.loads)
    >>> joint = rc.joint(rc.shear_law(curve, (steel, steel), friction=0.2), field, longest_wave=64e-6)
    >>> joint
    Joint(17 kN, normal 61.8 GN/m, shear 51.3 GN/m)
    >>> f"{joint.tilting[0, 0] / 1e6:.2f} MN m/rad, left out {joint.left_out_area * 1e6:.0f} mm^2"
    '2.64 MN m/rad, left out 129 mm^2'
    >>> f"{joint.shear_force(1e-7):.0f} N, {joint.loss(1e-7) * 1e6:.0f} uJ, damping {joint.damping(1e-7):.2f}"
    '2699 N, 273 uJ, damping 0.16'
    >>> f"{joint.conductance(conductivities=(50, 50))['thermal_conductance']:.0f} W/K"
    '28 W/K'
    >>> f"{joint.standard_error('normal_stiffness'):.1f}"  # of a single patch
    'nan'
    """

    field: PressureField
    normal: tuple[NormalLaw, ...]
    shear: tuple[ShearLaw, ...]
    longest_wave: float

    @cached_property
    def loaded(self) -> Mask:
        """Cells whose pressure lies within the laws, shape of the field."""
        p = self.field.pressure
        return np.asarray((p > 0) & (p >= max(each.lowest for each in self.normal)))

    @cached_property
    def stiffness_per_area(self) -> Array:
        """K of each cell [Pa/m], shape of the field: 0 in cells that are left out, NaN where there is no face."""
        p = self.field.pressure
        found = np.where(np.isnan(p), np.nan, 0.0)
        found[self.loaded] = np.mean([each.stiffness_at(p[self.loaded]) for each in self.normal], axis=0)
        return found

    @property
    def loaded_area(self) -> float:
        """Area of the face whose pressure lies within the laws [m^2]."""
        return int(np.count_nonzero(self.loaded)) * self.field.grid.cell_area

    @property
    def left_out_area(self) -> float:
        """Area of the face without pressure, or with one below the lowest load of a law [m^2]; it has no stiffness."""
        return self.field.face_area - self.loaded_area

    @property
    def left_out_force(self) -> float:
        """Force on the area that is left out [N]."""
        return float(np.nansum(self.field.pressure[~self.loaded])) * self.field.grid.cell_area

    @cached_property
    def normal_stiffness(self) -> float:
        """Normal force over the closing of the interface [N/m]."""
        return float(np.nansum(self.stiffness_per_area)) * self.field.grid.cell_area

    @cached_property
    def centre(self) -> tuple[float, float]:
        """Centre of stiffness ``(x, y)`` [m], from the first corner: a normal force there closes the face evenly."""
        weight = np.nan_to_num(self.stiffness_per_area)
        y, x = self.field.grid.coordinates
        total = weight.sum()
        return float(weight.sum(axis=0) @ x / total), float(weight.sum(axis=1) @ y / total)

    @cached_property
    def tilting(self) -> Array:
        """Tilting stiffness about the centre, a matrix along (x, y), shape (2, 2) [N m/rad].

        If the closing of the interface has the slopes a along x and y, the moments ``int p (r - c) dA`` are this matrix
        times a.
        """
        weight = np.nan_to_num(self.stiffness_per_area) * self.field.grid.cell_area
        y, x = self.field.grid.coordinates
        x, y = x - self.centre[0], y - self.centre[1]
        mixed = float(y @ weight @ x)
        return np.array([[weight.sum(axis=0) @ x**2, mixed], [mixed, weight.sum(axis=1) @ y**2]])

    @property
    def shear_stiffness(self) -> float:
        """Tangential force over displacement while nothing slips [N/m]; NaN without friction."""
        return self.normal_stiffness / self._ratio

    @property
    def torsional_stiffness(self) -> float:
        """Torque about the centre over the angle while nothing slips [N m/rad]; NaN without friction."""
        return float(np.trace(self.tilting)) / self._ratio

    @property
    def gross_slip_force(self) -> float:
        """Tangential force at which the whole joint slides, mu times the force [N]; NaN without friction."""
        return (self.shear[0].friction if self.shear else math.nan) * self.field.force

    @numeric(displacement="m")
    def shear_force(self, displacement: float | Array) -> Array:
        """Return the tangential force [N] of a face that is displaced rigidly: the sum of tau(s; p).

        Parameters
        ----------
        displacement : float or array
            Tangential displacement of the interface as it rises from zero [m].

        Returns
        -------
        float or array
            Force on the loaded area. Where first touch is not known, the last mu times the lowest load is exceeded at
            once.

        Raises
        ------
        ValueError
            If the joint has no friction, or a displacement is negative.
        """
        if not self.shear:
            raise InputError(
                "this joint has no friction: its laws are those of normal load",
                "build it of rc.shear_law(curve, bodies, friction=...)",
                "law",
            )
        s = positive(displacement, "the displacement [m]", zero=True)
        p = self.field.pressure[self.loaded]
        group = np.unique(np.round(np.log(p) / _ALIKE), return_inverse=True)[1]
        cells = np.bincount(group)
        p, found = np.bincount(group, p) / cells, np.zeros(np.shape(s))
        for law in self.shear:
            tau = law.traction(np.expand_dims(s, -1), p)
            found += np.where(np.isnan(tau), law.friction * p, tau) @ cells
        return np.asarray(found * (self.field.grid.cell_area / len(self.shear)))

    @numeric(displacement="m")
    def loss(self, displacement: float) -> float:
        """Return the energy that friction dissipates in a cycle between +amplitude and -amplitude [J].

        By Masing's rule, which holds for the sum: eight times the area between the backbone and its chord.

        Parameters
        ----------
        displacement : float
            Amplitude of the rigid displacement [m].

        Returns
        -------
        float
            Loss per cycle, to 1e-3 by quadrature.

        Raises
        ------
        ValueError
            If the joint has no friction, or the amplitude is so small that only single cells of the maps slip.
        """
        s = positive_scalar(displacement, "the displacement [m]")
        places = s * (1 + _NODES) / 2
        force = self.shear_force(np.append(places, s))
        mean = float(np.nansum(self.field.pressure**2) / np.nansum(self.field.pressure))
        least = max(each.smallest_share(mean) for each in self.shear)
        require(
            force[-1] >= least * self.gross_slip_force,
            f"at a force below {least:.3g} of that of gross slip, only single cells of the maps slip",
            "give a larger amplitude, or build the joint of laws `fitted`, whose stiffness has no steps",
            value=s,
            place="displacement",
        )
        return float(4 * s * _WEIGHTS @ (force[:-1] - force[-1] * places / s))

    @numeric(displacement="m")
    def damping(self, displacement: float) -> float:
        """Return the equivalent damping ratio of only the interface, not of a mode: loss over 4 pi times Q s/2.

        Parameters
        ----------
        displacement : float
            Amplitude, as of `loss` [m].

        Returns
        -------
        float
        """
        loss, force = self.loss(displacement), float(self.shear_force(displacement))
        return loss / (2 * math.pi * force * displacement)

    @numeric(resistivities="ohm*m", conductivities="W/m/K")
    def conductance(
        self,
        *,
        resistivities: tuple[float, float] | None = None,
        conductivities: tuple[float, float] | None = None,
    ) -> dict[str, Array]:
        """Return conductances and resistances of the joint from its normal stiffness, by the exact analogy.

        Parameters
        ----------
        resistivities, conductivities : tuple of float
            Values of both bodies [ohm m], [W/(m K)]: at least one of the two, see `roughcontact.conductance`.

        Returns
        -------
        dict of str to array
            ``thermal_conductance`` [W/K], ``electrical_conductance`` [S], and their inverses; only spots conduct.
        """
        modulus = self.normal[0].modulus
        return Conductors(resistivities, conductivities).of(np.asarray(self.normal_stiffness), modulus)

    def standard_error(self, name: str) -> Array:
        """Return the standard error of a number of this joint, from the scatter of its patches.

        It has two parts: the error of the mean of n patches, and the scatter of the joint itself, that of a patch times
        the root of (area of a patch)/(loaded area). The latter holds only at high pressure, with many contact spots in
        each patch: the scatter of K falls more slowly than the root of the area at low pressure.

        Parameters
        ----------
        name : str
            A number of the joint, such as ``"normal_stiffness"`` or ``"tilting"``.

        Returns
        -------
        float or array
            NaN with a single patch.
        """
        laws = zip(self.normal, self.shear or (None,) * len(self.normal), strict=True)
        each = [Joint(self.field, (one,), (two,) if two else (), math.nan) for one, two in laws]
        values = np.array([getattr(joint, name) for joint in each])
        if len(values) == 1:
            return np.full(values.shape[1:], np.nan)
        own = float(np.mean([law.map_area for law in self.normal])) / self.loaded_area
        return np.asarray(np.sqrt(values.var(axis=0, ddof=1) * (own + 1 / len(values))))

    @property
    def steep_share(self) -> float:
        """Share of the loaded area on which the pressure changes by its own value over three longest waves [1].

        A square of that side around the cell counts, without holes. NaN if the longest wave is not known.
        """
        if math.isnan(self.longest_wave):
            return math.nan
        p = self.field.pressure
        size = [max(1, round(WAVES * self.longest_wave / step)) for step in self.field.grid.spacing]
        high = maximum_filter(np.where(np.isnan(p), -np.inf, p), size, mode="nearest")
        low = minimum_filter(np.where(np.isnan(p), np.inf, p), size, mode="nearest")
        return float(np.mean((high - low >= p)[self.loaded]))

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these numbers, in sentences, the most important first."""
        return (*in_order(self._notes()), *(self.shear[0].notes if self.shear else ()))

    def _notes(self) -> Iterator[Note]:
        if self.left_out_force:
            share = 100 * self.left_out_force / self.field.force
            yield Note(
                Rank.LIMITED,
                f"Cells below {written(max(each.lowest for each in self.normal), 'Pa')}, the lowest load of the law, "
                f"are left out. They carry {share:.2g} % of the force.",
            )
        if math.isfinite(self.normal[0].hardness):
            words = "Every place of the face counts as pressed before by the largest load of the loop."
            yield Note(Rank.LIMITED, words)
        if math.isnan(self.longest_wave):
            words = "The longest wave of the roughness is not given: it is not known whether the law holds on the face."
            yield Note(Rank.LIMITED, words)
        elif (steep := self.steep_share) > 0:
            yield Note(
                Rank.DOUBTFUL,
                f"On {100 * steep:.2g} % of the loaded area, the pressure changes by its own value over three of the "
                f"longest waves ({written(self.longest_wave, 'm')}) or less: the law does not hold there.",
            )

    to_dataset = methods.joint_dataset
    to_record = methods.joint_record

    def __repr__(self) -> str:
        """Return the force and the main stiffnesses."""
        shear = f", shear {written(self.shear_stiffness, 'N m-1')}" if self.shear else ""
        return f"Joint({written(self.field.force, 'N')}, normal {written(self.normal_stiffness, 'N m-1')}{shear})"

    @property
    def _ratio(self) -> float:
        return self.shear[0].ratio if self.shear else math.nan


@numeric(longest_wave="m")
def joint(law: Law | Sequence[Law], field: PressureField, *, longest_wave: float | None = None) -> Joint:
    """Return the stiffness of a joint: the law of its interface under the pressure on its face.

    Parameters
    ----------
    law : NormalLaw or ShearLaw, or a sequence of one of them
        The law of the interface, or the laws of several patches of it; `ShearLaw` for the numbers under shear.
    field : PressureField
        Nominal pressure on the face.
    longest_wave : float, optional
        Length of the longest waves of the roughness [m], such as ``rc.hurst_exponent(surface).longest_wave``: the law
        holds where the pressure changes little over it.

    Returns
    -------
    Joint

    Raises
    ------
    ValueError
        If the field exceeds the highest load of a law, which is never extrapolated, or the laws have different bodies
        or frictions.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surfaces = [rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=k, rolloff=1.6e-5) for k in range(3)]
    >>> field = rc.PressureField(np.full((20, 30), 4e6), 1e-4)
    >>> laws = [rc.normal_law(rc.loading_curve(each, 1e9, pressures=field.loads)) for each in surfaces]
    >>> joint = rc.joint(laws, field, longest_wave=1.6e-5)
    >>> f"{joint.normal_stiffness / 1e9:.2f} +- {joint.standard_error('normal_stiffness') / 1e9:.2f} kN/um"
    '0.49 +- 0.02 kN/um'
    """
    if not isinstance(field, PressureField):
        raise about("field", f"must be a PressureField, such as of rc.bolt_pressure, not {shown(field)}")
    laws = tuple(law) if isinstance(law, Sequence) else (law,)
    if not laws or not all(isinstance(each, NormalLaw | ShearLaw) for each in laws):
        raise about("law", f"must be of rc.normal_law or rc.shear_law, or several of them, not {shown(law)}")
    shear = tuple(each for each in laws if isinstance(each, ShearLaw))
    normal = tuple(each.normal if isinstance(each, ShearLaw) else each for each in laws)
    kinds = {(each.friction, each.ratio) for each in shear} | ({None} if len(shear) < len(laws) else set())
    if len(kinds) > 1 or len({each.modulus for each in normal}) > 1:
        raise InputError(
            "the patches of a joint have different bodies or frictions",
            "make each law of the same bodies and with the same friction",
            "law",
        )
    largest = float(np.nanmax(field.pressure))
    low, high = max(each.lowest for each in normal), min(each.highest for each in normal)
    require(
        low <= largest <= high * (1 + 1e-12),
        f"the largest pressure on the face is {written(largest, 'Pa')}, and the law holds from {written(low, 'Pa')} to "
        f"{written(high, 'Pa')}: it is not extrapolated",
        "compute its curve with pressures=field.loads",
        place="field",
    )
    wave = math.nan if longest_wave is None else positive_scalar(longest_wave, "longest_wave [m]")
    return Joint(field, normal, shear, wave)
