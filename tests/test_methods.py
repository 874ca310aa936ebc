"""The pages of the methods beside the code: each line of an algorithm is cited where it is done, and no other line."""

import ast
import io
import re
import tokenize
from pathlib import Path

import pytest

import roughcontact

DOCS = Path(__file__).parents[1] / "docs" / "concepts"
CODE = Path(roughcontact.__file__).parent
PAGES = {
    "method.md": ("ABCD", "solver"),
    "method-adhesion.md": ("E", "adhesion"),
    "method-derivatives.md": ("G", "gradients"),
}
page_and_code = pytest.mark.parametrize("page", PAGES)


def labels(text, letters):
    return set(re.findall(rf"\b[{letters}]\d+\b", text))


def single_labels(text, letters):
    """Return the labels that a text cites one by one: "E1 to E16" cites none."""
    return labels(re.sub(rf"\b[{letters}]\d+ to [{letters}]\d+\b", "", text), letters)


def cited_in_comments(code, letters):
    """Return each label that a comment of the code cites with the lines of code beside these comments."""
    found = {}
    for token in tokenize.generate_tokens(io.StringIO(code).readline):
        if token.type == tokenize.COMMENT:
            for label in single_labels(token.string, letters):
                found.setdefault(label, []).append(token.line[: token.start[1]])
    return found


def functions_of(files):
    """Return the text of each function of some files under its name: the texts, where several have it."""
    found = {}
    for code in files:
        for node in ast.walk(ast.parse(code)):
            if isinstance(node, ast.FunctionDef):
                found.setdefault(node.name, []).append(ast.get_source_segment(code, node))
    return found


def algorithms(page, letters):
    """Return the lines of the algorithms of a page: each label with its text, up to the next label."""
    blocks = re.findall(r"^    +\S.*\n(?:^ +.*\n)*", page, re.MULTILINE)
    parts = [re.split(rf"^    +([{letters}]\d+) ", block, flags=re.MULTILINE)[1:] for block in blocks]
    return [pair for part in parts for pair in zip(part[::2], part[1::2], strict=True)]


def names(text):
    """Return the functions in the last column of a line of an algorithm."""
    columns = re.findall(r"\S {2,}([\w.]+(?:, [\w.]+)*)$", text, re.MULTILINE)
    return [name.split(".")[-1] for column in columns for name in column.split(", ")]


def read(page):
    letters, folder = PAGES[page]
    if not DOCS.is_dir():
        pytest.skip("no documentation here")
    files = sorted((CODE / folder).rglob("*.py"))
    return letters, algorithms((DOCS / page).read_text(), letters), [file.read_text() for file in files]


@page_and_code
def test_lines_are_numbered_in_order(page):
    letters, lines, _ = read(page)
    for letter in letters:
        numbers = [int(label[1:]) for label, _ in lines if label[0] == letter]
        assert numbers, letter
        assert numbers == list(range(1, len(numbers) + 1)), letter


@page_and_code
def test_each_line_is_cited_by_a_comment_beside_the_code_and_nothing_cites_a_line_that_is_not(page):
    letters, lines, files = read(page)
    known = {label for label, _ in lines}
    assert set().union(*(cited_in_comments(code, letters) for code in files)) == known
    assert set().union(*(labels(code, letters) for code in files)) == known


@page_and_code
def test_the_functions_that_a_page_names_do_the_line_or_are_called_there(page):
    letters, lines, files = read(page)
    named = [(label, name) for label, text in lines for name in names(text)]
    assert len(named) > 5
    functions, comments = functions_of(files), [cited_in_comments(code, letters) for code in files]
    for label, name in named:
        assert name in functions, f"{label}: no function {name}"
        inside = any(label in single_labels(text, letters) for text in functions[name])
        beside = [line for cited in comments for line in cited.get(label, [])]
        called = any(re.search(rf"\b{name}\b", line) for line in beside)
        assert inside or called, f"{label} is not cited in {name}, nor where it is called"


def test_a_range_and_a_docstring_cite_no_line_of_code():
    code = '"""Labels A1 to A4: A5."""\nx = first(1)  # A1, A2\n# A3 to A6, A7\n'
    assert {label: lines[0].strip() for label, lines in cited_in_comments(code, "A").items()} == {
        "A1": "x = first(1)",
        "A2": "x = first(1)",
        "A7": "",
    }
    assert labels(code, "A") == {"A1", "A2", "A3", "A4", "A5", "A6", "A7"}
