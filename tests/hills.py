"""One smooth surface of known heights, and texts of it, for tests of readers."""

import csv
import io

import numpy as np

NY, NX = 32, 36
STEP = 5e-7
Y, X = np.mgrid[0:NY, 0:NX]
HILLS = np.round(np.sin(2 * np.pi * X / NX) + 0.6 * np.cos(4 * np.pi * Y / NY + 1) + 0.5 * X * Y / NX / NY, 3)
HOLED = np.where((Y >= 8) & (Y < 24) & (X >= 10) & (X < 26), np.nan, HILLS)


def table(values=HILLS, separator=",", decimal=".", *, quoted=False, hole="nan", header=()):
    """Return rows of numbers as a text."""
    stream = io.StringIO()
    printed = [
        [hole if np.isnan(v) else f"{v:.3f}".replace(".", decimal) for v in row]
        for row in np.atleast_2d(values)
    ]
    if not quoted:
        return "".join(separator.join(row) + "\n" for row in [*header, *printed])
    csv.writer(stream, delimiter=separator, quoting=csv.QUOTE_ALL, lineterminator="\n").writerows(
        [*header, *printed]
    )
    return stream.getvalue()


def is_right(surface, values=HILLS, unit=1e-6, step=STEP):
    assert surface.heights.shape == values.shape
    np.testing.assert_allclose(surface.grid.spacing, (step,) * values.ndim, rtol=1e-6)
    # Printed to a thousandth of the unit, as the values are.
    np.testing.assert_allclose(surface.heights, values * unit, rtol=1e-12, atol=1e-9 * unit)
