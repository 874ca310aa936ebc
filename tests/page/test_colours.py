"""The colours of the maps on the ground of a page."""

import re
from importlib import resources

import pytest

STATIC = resources.files("roughcontact.page") / "static"
CONTRAST = 3.0  # of what is drawn, WCAG 2.2, 1.4.11


def luminance(colour):
    """Return the relative luminance of a colour of sRGB, six hexadecimal digits (WCAG 2.2)."""
    parts = [int(colour[k : k + 2], 16) / 255 for k in (0, 2, 4)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return sum(weight * part for weight, part in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


@pytest.mark.parametrize("name", ["VIRIDIS", "CIVIDIS"])
def test_a_low_pressure_stands_out_of_cells_without_contact_in_both_themes(name):
    """The lowest quarter of the colours: what lies above it is surrounded by it."""
    text = (STATIC / "colours.js").read_text(encoding="utf-8")
    digits = "".join(re.findall(r'"([0-9a-f]+)"', text.split(f"const {name} =")[1].split(";")[0]))
    colours = [digits[6 * k : 6 * k + 6] for k in range(64)]
    grounds = re.findall(r"--map-none: #([0-9a-f]{6})", (STATIC / "theme.css").read_text(encoding="utf-8"))
    assert len(grounds) == 2
    for ground in map(luminance, grounds):
        for colour in map(luminance, colours):
            assert (max(ground, colour) + 0.05) / (min(ground, colour) + 0.05) >= CONTRAST
