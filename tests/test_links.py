"""Links of the pages lead somewhere: to files that are there, and to headings of them.

python tests/test_links.py    lists the links to elsewhere, which no test follows
"""

import csv
import re
from pathlib import Path

import pytest

HOME = Path(__file__).parent.parent
MADE = re.compile(r"docs/(gallery|api)/|docs/project/[A-Z]")  # by a build of the site
PAGES = [
    *sorted(HOME.glob("*.md")),
    *(
        page
        for page in sorted(HOME.glob("docs/**/*.md"))
        if not MADE.match(page.relative_to(HOME).as_posix())
    ),
    *sorted(HOME.glob("reproduction/*.md")),
]
LINK = re.compile(r"\]\(<?([^)\s>]+)>?\)|(?:src|href)=\"([^\"]+)\"")
CODE = re.compile(r"^```.*?^```|`[^`\n]*`", re.DOTALL | re.MULTILINE)


def links(page):
    text = CODE.sub("", page.read_text(encoding="utf-8"))
    return [first or second for first, second in LINK.findall(text)]


def anchors(page):
    """Return the anchors of a page's headings, as repositories and the site make them."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    titles = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def missing(page):
    """Return the links of a page that lead nowhere in this repository."""
    found = []
    for link in links(page):
        if re.match(r"https?:|mailto:", link):
            continue
        name, _, anchor = link.partition("#")
        target = page.parent / name if name else page
        if not target.exists() or (anchor and target.suffix == ".md" and anchor not in anchors(target)):
            found.append(link)
    return found


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    assert missing(page) == []


def test_a_page_has_at_most_250_lines():
    """Beyond that it answers several questions. Pages of the methods are read from end to end."""
    long = {page.name for page in PAGES if len(page.read_text(encoding="utf-8").splitlines()) > 250}
    assert long <= {"method.md", "method-adhesion.md", "reproduction-figures.md"}, long


def test_every_data_file_is_a_table_of_a_page():
    shown = set()
    for page in PAGES:
        # A script writes the tables of some pages from their data file.
        names = re.findall(
            r"^(?::file:|<!-- tables of) (\S*)", page.read_text(encoding="utf-8"), re.MULTILINE
        )
        shown |= {(page.parent / name).resolve() for name in names}
    assert shown == set((HOME / "docs" / "data").resolve().rglob("*.csv"))
    for path in shown:
        head, *rows = csv.reader(path.read_text(encoding="utf-8").splitlines())
        assert rows, path.name
        assert {len(row) for row in rows} == {len(head)}, path.name


def test_a_link_that_leads_nowhere_is_seen(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("# One two\n[a](#one-two) [b](#three) [c](page.md#one-two) [d](gone.md) `[e](code.md)`\n")
    assert missing(page) == ["#three", "gone.md"]


if __name__ == "__main__":
    for page in PAGES:
        for link in links(page):
            if link.startswith("http"):
                print(page.relative_to(HOME), link)  # noqa: T201
