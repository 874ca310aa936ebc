"""Each picture of the gallery twice: as it is drawn, and on a dark ground."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.artist import Artist
from matplotlib.collections import Collection
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.text import Text

# What white and black become: ground and words of the theme's dark pages.
WHITE, BLACK = np.array([[0x14, 0x18, 0x1E], [0xCE, 0xD6, 0xDD]]) / 255
COLOURLESS = 0.1  # largest difference between red, green and blue of a grey

IMAGE = """
.. image:: /{path}
   :alt: {alt}
   :class: sphx-glr-single-img only-{theme}
"""


def scrape(block: Any, variables: dict[str, Any], settings: dict[str, Any]) -> str:
    """Save the figures of a script, light and dark, and return the lines of its page that show them."""
    shown = []
    alt = Path(variables["src_file"]).stem.replace("_", " ")
    for number in plt.get_fignums():
        figure = plt.figure(number)
        for theme in "light", "dark":
            path = Path(next(variables["image_path_iterator"]))
            if theme == "dark":
                darken(figure)
            figure.savefig(path)
            place = path.relative_to(settings["src_dir"]).as_posix()
            shown.append(IMAGE.format(path=place, alt=alt, theme=theme))
    plt.close("all")
    return "".join(shown)


def darken(figure: Figure) -> None:
    """Turn what is black, white or grey into its opposite; colours and maps stay."""
    for artist in figure.findobj(Artist):
        if isinstance(artist, Text):
            artist.set_color(opposite(artist.get_color()))
        elif isinstance(artist, Line2D):
            for part in "color", "markeredgecolor", "markerfacecolor":
                getattr(artist, f"set_{part}")(opposite(getattr(artist, f"get_{part}")()))
        elif isinstance(artist, Patch):
            face, edge = artist.get_facecolor(), artist.get_edgecolor()
            artist.set(facecolor=opposite(face), edgecolor=opposite(edge))
        elif isinstance(artist, Collection) and len(artist.get_facecolor()) <= 1:  # else they are data
            artist.set_facecolor([opposite(each) for each in artist.get_facecolor()])
            artist.set_edgecolor([opposite(each) for each in artist.get_edgecolor()])


def opposite(colour: Any) -> Any:
    """Return a grey from the other end of the scale; another colour as it is."""
    if isinstance(colour, str) and colour in ("none", "auto"):
        return colour
    *parts, opacity = to_rgba(colour)
    if np.ptp(parts) > COLOURLESS:
        return colour
    return (*(BLACK + (WHITE - BLACK) * np.mean(parts)), opacity)
