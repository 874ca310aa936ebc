"""A viscoelastic material in a file: TOML with units."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import tomli_w

from roughcontact.errors import InputError, within
from roughcontact.files.quantity import MODULUS, TIME, VISCOSITY
from roughcontact.recipe.texts import Amount, Choice, PureNumber, choose, temperature
from roughcontact.recipe.written import toml_in

if TYPE_CHECKING:
    from roughcontact.viscoelastic.prony_series import Viscoelastic

__all__ = ["read_material", "write_material"]

_MODULUS = Amount(MODULUS, positive=False, zero=True)
_READERS: dict[str, Callable[[str], Any]] = {
    "equilibrium": _MODULUS,
    "moduli": _MODULUS,
    "times": Amount(TIME),
    "dashpot": Amount(VISCOSITY, positive=False, zero=True),
    "band": Amount(TIME),
    "temperature": temperature,
    "misfit": PureNumber(0, 1e9, "misfit", "0.02"),
    "kind": Choice(("young", "shear", "reduced")),
    "poisson": PureNumber(-1, 0.5, "Poisson's ratio", "0.5"),
    "bulk": Amount(MODULUS),
}
_UNITS = {
    "equilibrium": "Pa",
    "moduli": "Pa",
    "times": "s",
    "dashpot": "Pa*s",
    "band": "s",
    "temperature": "K",
}
_LISTS = ("moduli", "times", "band")


def read_material(path: str | os.PathLike[str]) -> Viscoelastic:
    """Read a viscoelastic material from a TOML file.

    The fields are those of `Viscoelastic`, as numbers in SI or as texts with a unit. With ``kind = "young"`` or
    ``"shear"``, and ``poisson`` or ``bulk``, the moduli are converted as by `reduced`.

    Parameters
    ----------
    path : str or path
        TOML file.

    Returns
    -------
    Viscoelastic

    Raises
    ------
    ValueError
        If the file cannot be read, a field is unknown, or a value is not valid.

    Examples
    --------
    >>> import roughcontact as rc
    >>> with open("rubber.toml", "w") as file:
    ...     _ = file.write('''kind = "shear"
    ... poisson = 0.5
    ... equilibrium = "1MPa"
    ... moduli = ["2MPa", "6MPa"]
    ... times = ["0.1s", "5ms"]
    ... ''')
    >>> rubber = rc.Viscoelastic.read("rubber.toml")
    >>> rubber.equilibrium, rubber.moduli, rubber.times
    (4000000.0, (8000000.0, 24000000.0), (0.1, 0.005))
    >>> rubber.write("reduced.toml")
    >>> rc.Viscoelastic.read("reduced.toml") == rubber
    True
    """
    from roughcontact.files.content import content  # late, with NumPy
    from roughcontact.viscoelastic.conversions import reduced
    from roughcontact.viscoelastic.prony_series import Viscoelastic

    with content(path) as (_, data):
        given = toml_in(data)
    values: dict[str, Any] = {}
    for name, value in given.items():
        if name not in _READERS:
            raise InputError(f"a material has no field {name!r}", choose(name, tuple(_READERS)), name)
        if isinstance(value, list) != (name in _LISTS):
            raise InputError(
                f"{name} must be {'a list' if name in _LISTS else 'one value'}, not {value!r}",
                "write it as in docs/how-to/viscoelastic.md",
                name,
            )
        with within(name):
            read = [_READERS[name](str(each)) for each in (value if isinstance(value, list) else [value])]
        values[name] = tuple(read) if isinstance(value, list) else read[0]
    kind, poisson, bulk = (values.pop(name, None) for name in ("kind", "poisson", "bulk"))
    return reduced(Viscoelastic(**values), kind or "reduced", poisson=poisson, bulk=bulk)


def write_material(material: Viscoelastic, path: str | os.PathLike[str]) -> None:
    """Write a viscoelastic material as a TOML file, from which `Viscoelastic.read` returns the same numbers.

    Parameters
    ----------
    material : Viscoelastic
    path : str or path
        File to write; an existing file is replaced.

    Raises
    ------
    WriteError
        If the file cannot be written.

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> viscoelastic.standard_solid(1e6, 3e6, 0.5).write("rubber.toml")
    >>> with open("rubber.toml") as file:
    ...     print(file.read().strip())
    equilibrium = "1000000.0Pa"
    moduli = [
        "2000000.0Pa",
    ]
    times = [
        "0.5s",
    ]
    """
    from roughcontact.files.aside import written_aside

    plain: dict[str, Any] = {}
    for name, unit in {**_UNITS, "misfit": ""}.items():
        value = getattr(material, name)
        if isinstance(value, tuple) and value:
            plain[name] = [f"{each!r}{unit}" for each in value]
        elif value:
            plain[name] = f"{value!r}{unit}" if unit else value
    with written_aside(path) as aside:
        aside.write_text(tomli_w.dumps(plain), encoding="utf-8")
