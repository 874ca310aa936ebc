"""Notebooks of the course hold the cells of its pages, whose code and printed lines test_documentation.py runs."""

import re
import sys
from pathlib import Path

import pytest

pytest.importorskip("jupytext")
import nbformat

DOCS = Path(__file__).parent.parent / "docs"
sys.path.append(str(DOCS))
from course_notebooks import sheets, write_notebooks  # noqa: E402

PAGES = sheets(DOCS / "course")
CELL = re.compile(r"^```python\n(.*?)^```\n(?:\n```text\n(.*?)^```\n)?", re.DOTALL | re.MULTILINE)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Return the notebooks, by name, as the build of the site writes them."""
    folder = tmp_path_factory.mktemp("course")
    write_notebooks(DOCS / "course", folder)
    return {path.stem: nbformat.read(path, as_version=4) for path in folder.glob("*.ipynb")}


def cells(book):
    """Return code and printed lines of each cell of code."""
    found = [cell for cell in book.cells if cell.cell_type == "code"]
    return [(f"{cell.source}\n", "".join(output.text for output in cell.outputs)) for cell in found]


def words(book):
    return "\n".join(cell.source for cell in book.cells if cell.cell_type == "markdown")


def test_every_sheet_has_two_notebooks(made):
    assert len(PAGES) == 6
    assert set(made) == {f"{page.stem}{kind}" for page in PAGES for kind in ("", "-exercises")}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_notebook_holds_the_cells_of_its_page(page, made):
    text = page.read_text(encoding="utf-8")
    assert cells(made[page.stem]) == CELL.findall(text)
    nbformat.validate(made[page.stem])
    asked, answered = text.split("## Answers")
    handed_out = made[f"{page.stem}-exercises"]
    assert cells(handed_out) == CELL.findall(asked)
    assert "## Exercises" in words(handed_out)
    assert "Answer" not in words(handed_out)
    assert answered.count("<details>") == words(made[page.stem]).count("### Answer ")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_notebook_stands_alone(page, made):
    assert re.search(r"\]\((?!https?:)|<details>|^```text", words(made[page.stem]), re.MULTILINE) is None
