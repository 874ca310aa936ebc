"""The pages of the methods beside the code: each line of an algorithm is cited where it is done, and no other line."""

import re
from pathlib import Path

import pytest

import roughcontact

DOCS = Path(__file__).parents[1] / "docs"
CODE = Path(roughcontact.__file__).parent
PAGES = {"method.md": ("ABCD", "solver"), "method-adhesion.md": ("E", "adhesion")}


def numbered(text, letters):
    """Return the labels that a text cites, those between the ends of a range too."""
    found = set()
    for letter, first, last in re.findall(rf"\b([{letters}])(\d+)(?: to \1(\d+))?\b", text):
        found |= {f"{letter}{k}" for k in range(int(first), int(last or first) + 1)}
    return found


@pytest.mark.parametrize("page", PAGES)
def test_lines_are_numbered_in_order_and_cited(page):
    letters, folder = PAGES[page]
    if not DOCS.is_dir():
        pytest.skip("no documentation here")
    lines = re.findall(rf"^    +([{letters}])(\d+) ", (DOCS / page).read_text(), re.MULTILINE)
    for letter in letters:
        numbers = [int(number) for other, number in lines if other == letter]
        assert numbers == list(range(1, len(numbers) + 1)), letter
    code = "\n".join(file.read_text() for file in sorted((CODE / folder).glob("*.py")))
    assert numbered(code, letters) == {letter + number for letter, number in lines}
