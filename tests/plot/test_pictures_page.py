"""The page on pictures names all that draws."""

import re
from pathlib import Path

import pytest

import roughcontact as rc

PAGE = (Path(__file__).parents[2] / "docs" / "how-to" / "pictures.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", rc.plot.__all__)
def test_every_function_stands_on_it(name):
    assert re.search(rf"\b{name}\b", PAGE)
