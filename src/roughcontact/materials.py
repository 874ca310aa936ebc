"""Metals by name: handbook values at room temperature, and the moduli of a pair of metals."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from difflib import get_close_matches
from types import MappingProxyType
from typing import Any, TypeAlias

from roughcontact.errors import InputError, placed
from roughcontact.guesses import hinted
from roughcontact.material import Solid, inverse_sum, require_solid
from roughcontact.theory.joints.plane_waves import impedance
from roughcontact.validation import moderate, require, require_numbers, scalar

__all__ = [
    *("MATERIALS", "Elastic", "Material", "Modulus", "as_modulus", "handbook", "hardness_of"),
    *("reduced_modulus", "reduced_shear_modulus", "softer_of", "solids_of"),
]

_VICKERS = 9.80665e6  # Pa: a Vickers number is a force over the faces of the indentation, in kgf/mm^2
_ASM = "ASM Material Data Sheets (ASM International, MatWeb)"
_MODULI = "Kaye and Laby, Tables of Physical and Chemical Constants, 16th ed. (1995), section 2.2.2"
_CRC = "CRC Handbook of Chemistry and Physics, 97th ed. (2016), section 12"
_SAMSONOV = "Samsonov (ed.), Handbook of the Physicochemical Properties of the Elements (1968)"
_ALIASES = {"aluminum": "aluminium"}


@hinted
@dataclass(frozen=True, slots=True)
class Material:
    """A metal of a handbook, at room temperature.

    Parameters
    ----------
    name : str
        Name for `handbook`.
    grade : str
        Alloy and state to which the values belong.
    solid : Solid
        Young's modulus [Pa] and Poisson's ratio.
    hardness : float
        Vickers hardness [Pa]: 9.807 MPa times the number in kgf/mm^2.
    conductivity : float
        Thermal conductivity [W/(m K)].
    resistivity : float
        Electrical resistivity [ohm m].
    density : float
        Density [kg/m^3].
    sources : mapping of str to str
        Where each value comes from, by the name of its field.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.handbook("gold").conductivity
    317.0
    """

    name: str
    grade: str
    solid: Solid
    hardness: float
    conductivity: float
    resistivity: float
    density: float
    sources: Mapping[str, str] = field(hash=False, repr=False)

    def __post_init__(self) -> None:
        require_numbers(self, hardness="Pa", conductivity="W/m/K", resistivity="ohm*m", density="kg/m^3")
        object.__setattr__(self, "sources", MappingProxyType(dict(self.sources)))

    @property
    def impedance(self) -> float:
        """Acoustic impedance of longitudinal waves [Pa s/m]."""
        return impedance(self.solid.young_modulus, self.solid.poisson_ratio, self.density)

    def __reduce__(self) -> tuple[type[Material], tuple[Any, ...]]:
        """Return how copy and pickle rebuild the material: a view of a mapping can be neither copied nor pickled."""
        values = (getattr(self, each.name) for each in fields(self))
        return Material, tuple(dict(value) if isinstance(value, Mapping) else value for value in values)


Elastic: TypeAlias = Solid | Material | str
"""A solid, a material of a handbook, or its name."""
Modulus: TypeAlias = float | Elastic | tuple[Elastic, ...]
"""A reduced modulus E* [Pa], or the one or two bodies that it follows from."""


def _alloy(
    name: str,
    grade: str,
    solid: Solid,
    vickers: float,
    conductivity: float,
    resistivity: float,
    density: float,
) -> Material:
    """Return an alloy, all from one data sheet."""
    names = ("solid", "hardness", "conductivity", "resistivity", "density")
    sources = dict.fromkeys(names, f"{_ASM}: {grade}")
    return Material(name, grade, solid, vickers * _VICKERS, conductivity, resistivity, density, sources)


def _element(
    name: str, solid: Solid, hardness: float, conductivity: float, resistivity: float, density: float
) -> Material:
    """Return a pure metal."""
    sources = {
        "solid": _MODULI,
        "hardness": _SAMSONOV,
        "conductivity": f"{_CRC}: thermal conductivity of metals, 300 K",
        "resistivity": f"{_CRC}: electrical resistivity of pure metals, 293 K",
        "density": f"{_CRC}: thermal and physical properties of pure metals, 298 K",
    }
    grade = "pure, polycrystalline"
    return Material(name, grade, solid, hardness, conductivity, resistivity, density, sources)


# Young's modulus, Poisson's ratio; Vickers number (of an element: hardness in Pa); W/(m K); ohm m; kg/m^3.
_ALL = (
    _alloy("steel", "AISI 1045, cold drawn", Solid(205e9, 0.29), 188, 49.8, 162e-9, 7870.0),
    _alloy("stainless-steel", "AISI 304, annealed", Solid(193e9, 0.29), 129, 16.2, 720e-9, 8000.0),
    _alloy("aluminium", "6061-T6", Solid(68.9e9, 0.33), 107, 167.0, 39.9e-9, 2700.0),
    _alloy("titanium", "Ti-6Al-4V, annealed", Solid(113.8e9, 0.342), 349, 6.7, 1780e-9, 4430.0),
    _element("copper", Solid(129.8e9, 0.343), 369e6, 401.0, 16.78e-9, 8960.0),
    _element("silver", Solid(82.7e9, 0.367), 251e6, 429.0, 15.87e-9, 10500.0),
    _element("gold", Solid(78.0e9, 0.44), 216e6, 317.0, 22.14e-9, 19300.0),
    _element("nickel", Solid(199.5e9, 0.312), 638e6, 90.7, 69.3e-9, 8900.0),
    _element("tungsten", Solid(411.0e9, 0.280), 3430e6, 174.0, 52.8e-9, 19300.0),
)
MATERIALS: Mapping[str, Material] = MappingProxyType({each.name: each for each in _ALL})


def handbook(name: str) -> Material:
    """Return a metal by its name, with the values of handbooks at room temperature.

    Parameters
    ----------
    name : str
        One of ``"steel"``, ``"stainless-steel"``, ``"aluminium"``, ``"titanium"``, ``"copper"``, ``"silver"``,
        ``"gold"``, ``"nickel"``, ``"tungsten"``, in upper or lower case.

    Returns
    -------
    Material
        Its `solid`, `hardness`, `conductivity`, `resistivity`, `density`, and their `sources`.

    Raises
    ------
    ValueError
        If there is no material of this name.

    Notes
    -----
    Moduli are accurate to a few per cent. Hardness depends on cold work and heat treatment, by a factor of two or
    more, and is often larger at the size of contact spots. Resistivity depends on impurities. If your result depends
    on one of these values, measure it and pass the number.

    Examples
    --------
    >>> import roughcontact as rc
    >>> aluminium = rc.handbook("aluminium")
    >>> aluminium.grade, f"{aluminium.hardness / 1e9:.2f} GPa"
    ('6061-T6', '1.05 GPa')
    """
    key = _key(name)
    near = [each for each in MATERIALS if len(key) > 1 and each.startswith(key)]
    near = near or get_close_matches(key, MATERIALS, 1)
    require(
        key in MATERIALS,
        f"there is no material named {name!r}; there are {', '.join(MATERIALS)}",
        f"{f'did you mean {near[0]}? Otherwise ' if near else ''}give the numbers of the material, such "
        "as rc.Solid(210e9, 0.3)",
    )
    return MATERIALS[key]


def reduced_modulus(first: Elastic, second: Elastic | None = None) -> float:
    """Return the reduced modulus E* of two bodies (thesis, eq. 4.3).

    1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

    Parameters
    ----------
    first : Solid, Material or str
        A solid, or a material of the `handbook` or its name.
    second : Solid, Material or str, optional
        The other body; by default it is rigid.

    Returns
    -------
    float
        E* [Pa].

    Raises
    ------
    ValueError
        If a body is none of these, or both are rigid.

    Examples
    --------
    >>> import roughcontact as rc
    >>> f"{rc.reduced_modulus(rc.Solid(210e9, 0.3), rc.Solid(70e9, 0.33)) / 1e9:.2f} GPa"
    '58.61 GPa'
    >>> f"{rc.reduced_modulus('steel', 'aluminium') / 1e9:.2f} GPa"
    '57.47 GPa'
    """
    return as_modulus(solids_of(first, second))


def as_modulus(modulus: Modulus) -> float:
    """Return the reduced modulus E* [Pa] of a number, or of one or two bodies.

    Raises
    ------
    ValueError
        If the modulus is not positive and finite.
    """
    if (bodies := _bodies(modulus)) is None:
        value = scalar(modulus, "reduced modulus")
    elif len(bodies) in (1, 2):
        value = inverse_sum((1 - s.poisson_ratio**2) / s.young_modulus for s in solids_of(*bodies))
    else:
        raise InputError(
            f"two solids have a reduced modulus, not {len(bodies)}",
            "give one Solid, or a pair",
            place="modulus",
        )
    if not (math.isfinite(value) and value > 0):
        raise InputError(f"the reduced modulus must be positive and finite [Pa], not {value}")
    return moderate(value, "the reduced modulus [Pa]")


def softer_of(modulus: Modulus) -> Material | None:
    """Return the material with the smallest hardness among the bodies; None if no body is a material."""
    named = [handbook(body) if isinstance(body, str) else body for body in _bodies(modulus) or ()]
    materials = [body for body in named if isinstance(body, Material)]
    return min(materials, key=lambda material: material.hardness, default=None)


def reduced_shear_modulus(first: Elastic, second: Elastic | None = None) -> float:
    """Return the reduced shear modulus G* of two bodies (beside thesis, eq. 4.5).

    1/G* = (2 - nu1)/(4 G1) + (2 - nu2)/(4 G2), so that k/k_t = E*/G* for a circle.

    Parameters
    ----------
    first : Solid, Material or str
        A solid, or a material of the `handbook` or its name.
    second : Solid, Material or str, optional
        The other body; by default it is rigid.

    Returns
    -------
    float
        G* [Pa].

    Raises
    ------
    ValueError
        If a body is none of these, or both are rigid.

    Examples
    --------
    >>> import roughcontact as rc
    >>> steel = rc.Solid(210e9, 0.3)
    >>> f"k/k_t = {rc.reduced_modulus(steel) / rc.reduced_shear_modulus(steel):.4f} = (1 - nu/2)/(1 - nu)"
    'k/k_t = 1.2143 = (1 - nu/2)/(1 - nu)'
    """
    return inverse_sum((2 - s.poisson_ratio) / (4 * s.shear_modulus) for s in solids_of(first, second))


def hardness_of(value: Any) -> Any:
    """Return the hardness [Pa] of a material or of the material of that name; any other value as it is.

    Raises
    ------
    ValueError
        If there is no material of the name.
    """
    with placed("hardness"):
        material = handbook(value) if isinstance(value, str) else value
    return material.hardness if isinstance(material, Material) else value


def _bodies(modulus: Modulus) -> tuple[Elastic, ...] | None:
    """Return the bodies that a modulus follows from; None for a number."""
    if isinstance(modulus, Solid | Material) or (isinstance(modulus, str) and _key(modulus) in MATERIALS):
        return (modulus,)
    return modulus if isinstance(modulus, tuple) else None


def _key(name: str) -> str:
    key = str(name).casefold()
    return _ALIASES.get(key, key)


def solids_of(first: Elastic, second: Elastic | None = None) -> tuple[Solid, ...]:
    """Return the solids of one body, or of two.

    Raises
    ------
    ValueError
        If a body is neither a solid nor a material.
    """
    bodies = (first,) if second is None else (first, second)
    materials = (handbook(body) if isinstance(body, str) else body for body in bodies)
    return tuple(require_solid(each.solid if isinstance(each, Material) else each) for each in materials)
