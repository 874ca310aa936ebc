"""Random waves of unit power, each a function of only a key and its wave vector.

Therefore the waves of n cells are those of 2n, 3n and n + 1 cells without the finest, and any process can compute any
part of them. Random numbers come from a counter-based generator (Philox4x64-10, Salmon et al. 2011, Parallel random
numbers: as easy as 1, 2, 3), which turns a key and a counter into four words of 64 bits.

The wave with the integers ``(ky, kx)``, kx >= 0, has the wave vector ``2 pi (ky/Ly, kx/Lx)``; those of a line have
ky = 0. With key ``(K0, K1)`` the block of four words with the counter ``(kx // 2 + 1, ky mod 2^64, 0, 0)`` serves two
waves: words 0 and 1 that of even kx, words 2 and 3 that of odd kx. The first word w of a wave gives its phase,
``2 pi floor(w / 2^11) / 2^53``; the second its modulus if amplitudes are Gaussian, ``sqrt(-ln u)`` with
``u = (floor(w / 2^11) + 1) / 2^53``, that of a complex normal number with unit mean square. Where kx = 0 this holds for
ky >= 0, and the wave (-ky, 0) is the conjugate of (ky, 0).
"""

from __future__ import annotations

import math
from typing import Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from roughcontact.errors import about
from roughcontact.validation import RngLike, as_generator

__all__ = ["Amplitudes", "Keys", "draw_keys", "require_amplitudes", "unit_waves"]

Amplitudes: TypeAlias = Literal["exact", "gaussian"]
Words: TypeAlias = npt.NDArray[np.uint64]
Keys: TypeAlias = Words
Waves: TypeAlias = npt.NDArray[np.complex128]

_UNUSED = np.uint64(11)  # bits of a word that a double has no place for
_UNIT = 2.0**-53


def draw_keys(rng: RngLike, count: int = 1) -> Keys:
    """Return keys of 128 bits; a generator advances by two words a key.

    Parameters
    ----------
    rng : int, numpy.random.Generator, SeedSequence, BitGenerator or None
        Source of the keys.
    count : int
        Number of keys.

    Returns
    -------
    array of uint64, shape (count, 2)
        Keys, for `unit_waves`.

    Raises
    ------
    ValueError
        If `rng` is neither a generator nor a seed.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.surface.generation.random_phases import draw_keys
    >>> draw_keys(np.random.default_rng(1), 3).shape
    (3, 2)
    """
    # All values of a word are allowed: NumPy uses each drawn word and rejects none.
    return as_generator(rng).integers(0, 2**64 - 1, (count, 2), dtype=np.uint64, endpoint=True)


def require_amplitudes(amplitudes: str) -> None:
    """Refuse an unknown kind of amplitudes."""
    if amplitudes not in ("exact", "gaussian"):
        raise about("amplitudes", f"must be 'exact' or 'gaussian', not {amplitudes!r}")


def unit_waves(keys: Keys, ky: npt.ArrayLike, kx: tuple[int, int], amplitudes: Amplitudes = "exact") -> Waves:
    """Return the complex amplitudes of waves of unit power, for any part of the half-plane kx >= 0.

    Parameters
    ----------
    keys : array of uint64, shape (1, 2) or (rows, 2)
        One for all rows, or one for each; from `draw_keys`.
    ky : array_like of int, shape (rows,) or ()
        Signed integers of the waves along y, in any order; 0 for lines.
    kx : tuple of int
        First of the integers along x, not negative, and the one after the last.
    amplitudes : {"exact", "gaussian"}
        "exact": all of modulus 1. "gaussian": complex normal numbers with unit mean square, of the same phases.

    Returns
    -------
    complex array, shape (rows, columns)
        Heights at the place x from the origin are the sum of ``B Re(wave exp(i q x))`` over all wave vectors. The wave
        (0, 0) is a constant: callers ignore it.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.surface.generation.random_phases import draw_keys, unit_waves
    >>> keys = draw_keys(np.random.default_rng(1))
    >>> some, more = unit_waves(keys, [2, -3], (5, 7)), unit_waves(keys, np.arange(-4, 4), (0, 9))
    >>> bool((some == more[[6, 1], 5:7]).all())
    True
    """
    require_amplitudes(amplitudes)
    first, end = kx
    rows = np.broadcast_shapes(np.shape(ky), (len(keys),))
    numbers, keys = np.broadcast_to(np.asarray(ky, np.int64), rows), np.broadcast_to(keys, (*rows, 2))
    words = _words(keys, numbers, first, end)
    back = (numbers < 0) & (first == 0 < end)
    words[back, :1] = _words(keys[back], -numbers[back], 0, 1)
    # Cosine and sine from the tangent t of half the angle, several times faster in NumPy: 2/(1 + t^2) - 1 and
    # 2t/(1 + t^2). Pi is subtracted to move the poles to the ends, which changes both signs.
    tangent = (words[..., 0] >> _UNUSED) * (math.pi * _UNIT)
    tangent -= math.pi / 2
    np.tan(tangent, out=tangent)
    share = np.square(tangent)
    share += 1
    np.divide(-2, share, out=share)
    waves = np.empty(tangent.shape, np.complex128)
    np.add(share, 1, out=waves.real)
    np.multiply(tangent, share, out=waves.imag)
    if amplitudes == "gaussian":
        waves *= np.sqrt(-np.log(((words[..., 1] >> _UNUSED) + np.uint64(1)) * _UNIT))
    if back.any():
        waves.imag[back, 0] *= -1
    return waves


def _words(keys: Keys, ky: npt.NDArray[np.int64], first: int, end: int) -> Words:
    """Return the two words of every wave, shape (rows, columns, 2)."""
    start = first // 2
    blocks = max(0, (end + 1) // 2 - start)
    words = np.empty((len(ky), 4 * blocks), np.uint64)
    philox = np.random.Philox(0)
    state = philox.state
    counter = state["state"]["counter"] = np.zeros(4, np.uint64)
    counter[0] = start  # NumPy increments the counter before it draws
    for row, (key, number) in enumerate(zip(keys, ky.view(np.uint64), strict=True)):
        counter[1], state["state"]["key"] = number, key
        philox.state = state
        words[row] = philox.random_raw(4 * blocks)
    return words.reshape(len(ky), 2 * blocks, 2)[:, first - 2 * start : end - 2 * start]
