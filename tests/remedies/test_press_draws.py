"""What is refused of surfaces drawn by a measured spectrum: the message is followed, and the intervals are there."""

from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
from followed import follow, row

Q = np.geomspace(2e5, 2e6, 6)
ONE = np.full(6, 0.1)
SPECTRUM = rc.CombinedSpectrum(
    *(Q, 1e-26 * (Q / Q[0]) ** -3.6, "C2D", ONE, ONE, ONE, 9 * ONE, ("map",), ONE[None], 2e5, 2e6, (), ())
)
UNKNOWN = replace(SPECTRUM, log_spread=ONE * np.nan)
NARROW = replace(SPECTRUM, **{name: getattr(SPECTRUM, name)[:1] for name in (
    "wavenumber", "density", "log_error", "log_waves", "log_spread", "freedom"
)})  # fmt: skip


def draws(spectrum=SPECTRUM, size=3e-5, draws=2, **options):
    return rc.press_draws(spectrum, 1e9, 1e5, size, draws=draws, rng=1, **options)


REFUSED = [
    row(
        lambda: draws(replace(SPECTRUM, kind="C1D")),
        "spectrum must be that of maps (C2D), not of profiles: combine maps without profiles",
        draws,
    ),
    row(lambda: draws(NARROW), "needs at least two bins: measure a wider band", draws),
    row(
        lambda: draws(of="next"),
        "of must be 'specimen' or 'mean', not 'next'",
        lambda: draws(of="specimen"),
        lambda: draws(of="mean"),
    ),
    row(lambda: draws(draws=1), "give 19 for an interval of 90 %", lambda: draws(draws=19)),
    row(
        lambda: draws(UNKNOWN),
        "the scatter between places is not known from one map: measure at least two places, or give of='mean'",
        draws,
        lambda: draws(UNKNOWN, of="mean"),
    ),
    row(
        lambda: draws(size=1e-6),
        "must be at least four of the shortest waves, 3.14e-06 m, not 1e-06: give 1.26e-05 m or more",
        lambda: draws(size=1.26e-5),
    ),
    row(
        lambda: draws(size=1e-2),
        "size [m] needs 19200 cells a side for the shortest wave of 3.14e-06 m, more than 2048: give at most 0.00107 m",
        lambda: draws(size=1.2e-4),  # smaller, for the time of the test
    ),
]


@pytest.mark.parametrize("refusal", REFUSED)
def test_draws(refusal):
    follow(refusal)
