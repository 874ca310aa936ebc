"""Liquids and gases that flow through a gap or conduct heat across it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.validation import Array, numeric, require_numbers, scalar

__all__ = ["Gas", "Liquid"]

TABLE_TEMPERATURE = 300.0  # K
GAS_CONSTANT = 8.314462618  # J/(mol K)
SLIP_DIFFUSE, SLIP_SLOPE = 1.0162, 0.1211  # of the pressure-driven slip coefficient, Cercignani and Loyalka


class _Tabled(NamedTuple):
    """Properties of a gas at 300 K, and Sutherland's temperature of its viscosity."""

    conductivity: float  # W/(m K)
    viscosity: float  # Pa s
    heat_ratio: float
    molar_mass: float  # kg/mol
    sutherland: float  # K


_GASES = {
    "air": _Tabled(26.2e-3, 18.6e-6, 1.4, 28.97e-3, 110.4),
    "nitrogen": _Tabled(26.0e-3, 17.9e-6, 1.4, 28.01e-3, 111.0),
    "helium": _Tabled(156.7e-3, 20.0e-6, 5 / 3, 4.0026e-3, 79.4),
    "argon": _Tabled(17.9e-3, 22.9e-6, 5 / 3, 39.95e-3, 144.4),
}


@dataclass(frozen=True, slots=True)
class Liquid:
    """An incompressible fluid.

    Parameters
    ----------
    viscosity : float
        Dynamic viscosity [Pa s].
    density : float, optional
        Density [kg/m^3], for the mass flow and the Reynolds number.
    vapour_pressure : float
        Pressure below which it boils [Pa].

    Raises
    ------
    ValueError
        If the viscosity or the density is not positive.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.Liquid(viscosity=1e-3, density=1000).viscosity
    0.001
    """

    viscosity: float
    density: float | None = None
    vapour_pressure: float = 0.0

    def __post_init__(self) -> None:
        require_numbers(self, viscosity="Pa*s", density="kg/m^3", vapour_pressure="Pa")
        for name in ("viscosity", "density"):
            value = getattr(self, name)
            if value is not None and not 0 < value < math.inf:
                raise about(f"the {name}", f"must be positive and finite, not {value}")


@dataclass(frozen=True, slots=True)
class Gas:
    """An ideal gas.

    Parameters
    ----------
    name : {"air", "nitrogen", "helium", "argon"}
        Properties at 300 K as in the CRC Handbook; viscosity and conductivity depend on the temperature by Sutherland's
        law, with commonly tabulated constants: within 4 % and 7 % of that handbook from 200 to 600 K.
    temperature : float
        Temperature [K], between 200 and 600.
    pressure : float, optional
        Absolute pressure [Pa], for the conduction of heat.
    accommodation : tuple of float, optional
        Thermal accommodation coefficients of both walls [1], for the conduction of heat. Often quoted are 0.85 to 0.95
        for air, nitrogen and argon on engineering metals, 0.3 to 0.6 for helium. Trott and others (Sandia 2010)
        measured about 0.95 for argon, 0.85 for nitrogen and 0.45 for helium on most surfaces.
    momentum_accommodation : float
        Part of the molecules that both walls reflect diffusely [1], for slip.

    Raises
    ------
    ValueError
        If the gas is unknown, or a number is out of range.

    Examples
    --------
    >>> import roughcontact as rc
    >>> air = rc.Gas("air", temperature=300)
    >>> f"{air.mean_free_path(101325) * 1e9:.1f} nm"
    '67.5 nm'
    """

    name: str
    temperature: float = TABLE_TEMPERATURE
    pressure: float | None = None
    accommodation: tuple[float, float] | None = None
    momentum_accommodation: float = 1.0

    def __post_init__(self) -> None:
        require_numbers(self, temperature="K", pressure="Pa")
        if self.name not in _GASES:
            raise about("the gas", f"must be one of {', '.join(_GASES)}, not {self.name!r}")
        if not 200 <= self.temperature <= 600:
            given = f"{self.temperature:g} K"
            raise InputError(
                f"the temperature must be between 200 and 600 K, not {given}",
                "give kelvin, or degrees Celsius with their unit, such as 20degC",
                "temperature",
            )
        if self.pressure is not None and not 0 < self.pressure < math.inf:
            raise about("the pressure", f"must be positive and finite [Pa], not {self.pressure}")
        if self.accommodation is not None:
            both = tuple(scalar(each, "an accommodation coefficient") for each in self.accommodation)
            if len(both) != 2 or not all(0 < each <= 1 for each in both):
                raise about("the accommodation", f"must be two coefficients above 0 and up to 1, not {both}")
            object.__setattr__(self, "accommodation", both)
        if not 0 < self.momentum_accommodation <= 1:
            raise about(
                "momentum_accommodation", f"must be above 0 and up to 1, not {self.momentum_accommodation}"
            )

    @property
    def viscosity(self) -> float:
        """Dynamic viscosity [Pa s]."""
        return self._tabled.viscosity * self._sutherland

    @property
    def conductivity(self) -> float:
        """Thermal conductivity [W/(m K)], at a constant Prandtl number."""
        return self._tabled.conductivity * self._sutherland

    @property
    def heat_ratio(self) -> float:
        """Ratio of the specific heats [1]."""
        return self._tabled.heat_ratio

    @property
    def gas_constant(self) -> float:
        """Specific gas constant [J/(kg K)]."""
        return GAS_CONSTANT / self._tabled.molar_mass

    @property
    def prandtl(self) -> float:
        """Prandtl number [1]."""
        heat = self.heat_ratio / (self.heat_ratio - 1) * self.gas_constant
        return self.viscosity * heat / self.conductivity

    @numeric(pressure="Pa")
    def mean_free_path(self, pressure: float) -> float:
        """Return the mean free path by the viscosity, ``eta/p sqrt(pi R T/2)`` [m].

        Parameters
        ----------
        pressure : float
            Absolute pressure [Pa].

        Returns
        -------
        float

        Examples
        --------
        >>> import roughcontact as rc
        >>> f"{rc.Gas('helium').mean_free_path(101325) * 1e9:.1f} nm"
        '195.3 nm'
        """
        return self.viscosity / pressure * math.sqrt(math.pi * self.gas_constant * self.temperature / 2)

    @numeric(gap="m", pressure="Pa")
    def rarefaction(self, gap: float, pressure: float) -> float:
        """Return the rarefaction parameter ``p g/(eta sqrt(2 R T))`` of a gap.

        Parameters
        ----------
        gap : float
            Gap [m].
        pressure : float
            Absolute pressure [Pa].

        Returns
        -------
        float

        Examples
        --------
        >>> import roughcontact as rc
        >>> round(rc.Gas("air").rarefaction(1e-6, 101325), 2)
        13.13
        """
        return pressure * gap / (self.viscosity * math.sqrt(2 * self.gas_constant * self.temperature))

    @numeric(pressure="Pa")
    def slip_length(self, pressure: float) -> float:
        """Return the slip length at a wall [m].

        Parameters
        ----------
        pressure : float
            Absolute pressure [Pa].

        Returns
        -------
        float

        Examples
        --------
        >>> import roughcontact as rc
        >>> f"{rc.Gas('air').slip_length(101325) * 1e9:.1f} nm"
        '77.4 nm'
        """
        a = self.momentum_accommodation
        coefficient = (2 - a) / a * (SLIP_DIFFUSE - SLIP_SLOPE * (1 - a))
        return 2 / math.sqrt(math.pi) * coefficient * self.mean_free_path(pressure)

    @property
    def jump_distance(self) -> float:
        """Sum of the temperature jump distances at both walls [m]; Yovanovich's M.

        Raises
        ------
        ValueError
            Without pressure and accommodation coefficients.
        """
        if self.pressure is None or self.accommodation is None:
            raise InputError(
                "the conduction of heat by a gas depends on its pressure and on the accommodation at both walls",
                f"give them: rc.Gas({self.name!r}, pressure=101325, accommodation=(0.9, 0.9))",
                "pressure, accommodation",
            )
        walls = sum((2 - a) / a for a in self.accommodation)
        ratio = 2 * self.heat_ratio / (self.heat_ratio + 1)
        return walls * ratio * self.mean_free_path(self.pressure) / self.prandtl

    @numeric(gap="m")
    def conductance(self, gap: float | Array) -> Array:
        """Return the conductance ``k_g/(gap + jump distance)`` of gaps per area [W/(m^2 K)].

        Parameters
        ----------
        gap : float or array
            Distance of both walls [m].

        Returns
        -------
        array
            Conductance per area [W/(m^2 K)].

        Raises
        ------
        ValueError
            Without pressure and accommodation coefficients.

        Examples
        --------
        >>> import roughcontact as rc
        >>> air = rc.Gas("air", pressure=101325, accommodation=(1, 1))
        >>> f"{air.conductance(2e-6):.3g} W/(m^2 K)"
        '1.18e+04 W/(m^2 K)'
        """
        return np.asarray(self.conductivity / (gap + self.jump_distance))

    @property
    def _tabled(self) -> _Tabled:
        return _GASES[self.name]

    @property
    def _sutherland(self) -> float:
        """Viscosity over that at 300 K."""
        ratio, s = self.temperature / TABLE_TEMPERATURE, self._tabled.sutherland
        return ratio * math.sqrt(ratio) * (TABLE_TEMPERATURE + s) / (self.temperature + s)
