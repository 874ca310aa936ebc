"""An instrument, as far as it limits the waves that a map holds."""

from __future__ import annotations

from dataclasses import dataclass

from roughcontact.errors import about
from roughcontact.evaluation.noise import Noise
from roughcontact.validation import positive, require_numbers, shown

__all__ = ["Instrument"]


@dataclass(frozen=True, slots=True)
class Instrument:
    """An instrument that measures heights. What is not stated is not corrected.

    Parameters
    ----------
    name : str
        Its name, such as "AFM".
    resolution : float, optional
        Lateral period limit [m]: the wavelength whose amplitude the instrument halves (ISO 25178-600). Spectra are
        divided by the square of a Gaussian response, ``2^(-2 (resolution/wavelength)^2)``.
    tip_radius : float, optional
        Radius of a tip that follows the surface [m].
    noise : Noise, optional
        Random errors of one map.

    Raises
    ------
    ValueError
        If a length is not positive, or the noise is not a `Noise`.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.Instrument("interferometer", resolution=1e-6, noise=rc.Noise(rms=1e-9)).resolution
    1e-06
    """

    name: str = ""
    resolution: float | None = None
    tip_radius: float | None = None
    noise: Noise | None = None

    def __post_init__(self) -> None:
        require_numbers(self, resolution="m", tip_radius="m")
        for name in ("resolution", "tip_radius"):
            if (value := getattr(self, name)) is not None:
                object.__setattr__(self, name, float(positive(value, f"{name} [m]")))
        if not isinstance(self.noise, Noise | None):
            raise about("noise", f"must be a Noise, not {shown(self.noise)}", "give rc.Noise(rms=...)")
