"""Notebooks of the course, written by every build of the site from the same Markdown as its pages."""

import re
from pathlib import Path

import jupytext
import nbformat
from nbformat.v4 import new_output

# What only a page has: pictures, which the cells of a notebook draw, targets of links, and the folding of answers.
PICTURE = re.compile(r"^!\[.*\]\(.*\)\n\n", re.MULTILINE)
LINK = re.compile(r"\[([^\]]*)\]\((?!https?:)[^)]*\)")
FOLD = re.compile(r"^</?details>\n\n?", re.MULTILINE)
SUMMARY = re.compile(r"<summary>(.*)</summary>")
ANSWERS = "\n## Answers\n"
PRINTED = re.compile(r"\A```text\n(.*?)^```\n*", re.DOTALL | re.MULTILINE)


def sheets(folder: Path) -> list[Path]:
    """Return the pages of the course that have a notebook."""
    return sorted(folder.glob("[0-9]-*.md"))


def notebook(page: str) -> nbformat.NotebookNode:
    """Return a page as a notebook: blocks of Python are cells, and what they print is their output."""
    text = SUMMARY.sub(r"### \1", FOLD.sub("", LINK.sub(r"\1", PICTURE.sub("", page))))
    book = jupytext.reads(text, fmt="md")
    for cell, after in zip(book.cells, book.cells[1:], strict=False):
        if cell.cell_type == "code" and (printed := PRINTED.match(after.source + "\n")):
            cell.outputs = [new_output("stream", text=printed[1])]
            after.source = after.source[printed.end() :]
    book.cells = [cell for cell in book.cells if cell.source]
    book.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    return book


def write_notebooks(folder: Path, target: Path) -> None:
    """Write the notebooks of the pages in a folder, with answers and without, beside the pages in the site."""
    for page in sheets(folder):
        text = page.read_text(encoding="utf-8")
        nbformat.write(notebook(text), target / f"{page.stem}.ipynb")
        nbformat.write(notebook(text.partition(ANSWERS)[0]), target / f"{page.stem}-exercises.ipynb")


def offer(name: str) -> str:
    """Return the line of a page, in Markdown, that offers its notebooks."""
    links = ((name, "with answers"), (f"{name}-exercises", "without answers"))
    offered = " or ".join(f'<a href="{file}.ipynb" download>{words}</a>' for file, words in links)
    return f"\n\nThis page as a notebook: {offered}.\n\n"
