"""Elements of an XML document by their local names, each wrong value refused with its place."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from types import SimpleNamespace

from roughcontact.files.file_errors import ReadError

__all__ = ["Node", "local_name", "parse_xml"]

_AGAIN = "export the surface again"


@dataclass(frozen=True, slots=True, eq=False)
class Node:
    """An element, its descendants found by paths of local names: writers disagree about the namespace."""

    element: ElementTree.Element
    file: str

    def find(self, path: str) -> ElementTree.Element | None:
        """Return the element at `path`, or None."""
        element: ElementTree.Element | None = self.element
        for part in path.split("/"):
            if element is not None:
                element = next((child for child in element if local_name(child) == part), None)
        return element

    def child(self, path: str) -> Node:
        """Return the element at `path`, which must be there."""
        element = self.find(path)
        if element is None:
            raise ReadError(self.file, f"its main.xml has no {path}", _AGAIN)
        return Node(element, self.file)

    def text(self, path: str, default: str = "") -> str:
        """Return the text at `path`, or `default` where it is absent or empty."""
        element = self.find(path)
        text = "" if element is None else (element.text or "").strip()
        return text or default

    def number(self, path: str, default: float | None = None) -> float:
        """Return the finite number at `path`, or `default` where it is absent or empty."""
        text = self.text(path)
        if not text and default is not None:
            return default
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise ReadError(self.file, f"its main.xml states {text!r} for {path}", _AGAIN)
        return value


def local_name(element: ElementTree.Element) -> str:
    """Return the name of an element without its namespace."""
    return str(element.tag).rpartition("}")[2]


def parse_xml(main: bytes, file: str) -> Node:
    """Return the root of ``main.xml``."""

    def refuse(*_: str | None) -> None:
        raise ReadError(file, "its main.xml declares a document type, which X3P does not know", _AGAIN)

    builder = ElementTree.TreeBuilder()
    # The parser knows a document type in any encoding; it comes before all that could be made to grow.
    target = SimpleNamespace(
        start=builder.start, end=builder.end, data=builder.data, close=builder.close, doctype=refuse
    )
    try:
        return Node(ElementTree.fromstring(main, ElementTree.XMLParser(target=target)), file)
    except ReadError:
        raise
    except Exception as error:  # ParseError, but also LookupError and ValueError over the declared encoding
        raise ReadError(file, f"its main.xml is damaged ({error})", _AGAIN) from error
