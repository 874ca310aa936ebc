"""Nanoscope images whose aspect ratio is not 1:1: their "Scan Size" repeats the width, though the height is less."""

from __future__ import annotations

import math
from collections.abc import Mapping

__all__ = ["height_factors"]

_SCAN = {"ciao scan list", "afm list", "stm list", "nc afm list"}
_ROUNDED = 0.005  # relative error of an aspect ratio by its printed digits


def height_factors(data: bytes) -> list[float | str]:
    """Return the factor for the stated height of each image, or the contradictory statements of the file.

    The height follows from the aspect ratio and from the number of lines. If these agree to within a line, the number
    of lines is used; otherwise the height is unknown. A "Slow Axis Size" is the height; so is a second number of the
    "Scan Size" that differs from the width and agrees with the aspect ratio.
    """
    scan: dict[str, str] = {}
    images: list[dict[str, str]] = []
    section: dict[str, str] = {}
    for line in data.partition(b"\\*File list end")[0].decode("latin-1").splitlines():
        if line.startswith("\\*"):
            name = line[2:].strip().casefold()
            section = scan if name in _SCAN else {}
            if name.endswith("image list"):
                images.append(section)
        else:
            key, _, value = line.lstrip("\\").partition(":")
            section[key.strip().casefold()] = value.strip()
    return [_factor(image, scan) for image in images]


def _factor(image: Mapping[str, str], scan: Mapping[str, str]) -> float | str:
    ratio = _ratio(image.get("aspect ratio", scan.get("aspect ratio", "")))
    if ratio == 1 or "slow axis size" in scan:
        return 1.0
    size, nx, ny = image.get("scan size", ""), _number(image, "samps/line"), _number(image, "number of lines")
    lines = _number(scan, "lines")
    # A square scan that was stopped early covers a share of its lines; otherwise the cells are square.
    by_lines = ny / lines if _ratio(scan.get("aspect ratio", "")) == 1 and lines >= ny else ny / nx
    sides = [float(word) for word in size.split() if _is_number(word)]
    whole = _number(image, "data length") in (2 * nx * ny, 4 * nx * ny)
    stated = sides[1] / sides[0] if len(sides) == 2 and sides[0] > 0 else 1.0
    if whole and stated == 1 and math.isclose(1 / ratio, by_lines, rel_tol=1 / ny + _ROUNDED):
        return by_lines
    if whole and stated != 1 and math.isclose(1 / ratio, stated, rel_tol=1 / ny + _ROUNDED):
        return 1.0
    return (
        f"a scan size of {size}, an aspect ratio of {image.get('aspect ratio')} and {nx:g} x {ny:g} points (x, y), "
        "which contradict each other"
    )


def _ratio(text: str) -> float:
    """Return width over height; 1 if none is stated."""
    width, colon, height = text.partition(":")
    if not (colon and _is_number(width) and _is_number(height) and float(width) > 0 and float(height) > 0):
        return 1.0
    return float(width) / float(height)


def _number(section: Mapping[str, str], name: str) -> float:
    text = section.get(name, "")
    return float(text) if _is_number(text) else math.nan


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False
