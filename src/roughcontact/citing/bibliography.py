"""The references of the program, as entries of BibTeX and as lines of text."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources

from roughcontact.version import __version__

__all__ = ["Citations", "Reference", "references"]

_ENTRY = re.compile(r"^@(\w+)\{(\w+),\n(.*?)^\}$", re.DOTALL | re.MULTILINE)
_FIELD = re.compile(r"(\w+) = \{((?:[^{}]|\{[^{}]*\})*)\}")


@dataclass(frozen=True, slots=True)
class Reference:
    """An entry of a bibliography.

    Parameters
    ----------
    key, kind : str
        ``"Love1929"``, ``"article"``.
    fields : mapping of str to str
        The fields of BibTeX.
    keywords : frozenset of str
        The methods or results that it is cited for.
    """

    key: str
    kind: str
    fields: Mapping[str, str]
    keywords: frozenset[str]

    @property
    def bibtex(self) -> str:
        """The entry as BibTeX."""
        lines = (f"  {name} = {{{value}}},\n" for name, value in self.fields.items())
        return f"@{self.kind}{{{self.key},\n{''.join(lines)}}}\n"

    def is_in(self, text: str) -> bool:
        """Return whether a text cites it: ``"Wear 35, 87 (1975)"``, ``"Yovanovich (1982)"``, ``"thesis, eq. 5.9"``."""
        get, page = self.fields.get, self.fields.get("pages", "").partition("-")[0]
        place = f"{get('journal')} {get('volume')}, {page} "
        author = f"{self.fields['author'].partition(',')[0]} ({get('year')})"
        return place in text or author in text or (self.kind == "phdthesis" and "thesis" in text)

    def __str__(self) -> str:
        """Return authors, title, place and DOI as a line."""
        found = {name: re.sub(r"[{}]|``|''", "", value) for name, value in self.fields.items()}
        parts = [_people(found["author"]), found["title"]]
        if "journal" in found:
            parts.append(f"{found['journal']} {found['volume']}, {found['pages'].partition('-')[0]}")
        if "booktitle" in found:
            parts.append(f"in {_people(found['editor'])} (eds.), {found['booktitle']}")
        parts += [found[name] for name in ("number", "publisher", "school", "note") if name in found]
        year = f" ({found['year']})" if "year" in found else ""
        return ", ".join(parts) + year + (f", doi:{found['doi']}" if "doi" in found else "")


@dataclass(frozen=True, slots=True)
class Citations:
    """The references behind a result, as text and as BibTeX.

    Parameters
    ----------
    references : tuple of Reference
        The program first.

    Examples
    --------
    >>> import roughcontact as rc
    >>> found = rc.citations(rc.PolonskyKeer())
    >>> print(str(found)[:66])
    The roughcontact developers, roughcontact: elastic contact of roug
    >>> print(found.references[-1].bibtex.splitlines()[0])
    @article{Polonsky1999,
    """

    references: tuple[Reference, ...]

    @property
    def bibtex(self) -> str:
        """The entries as BibTeX, in UTF-8."""
        return "\n".join(each.bibtex for each in self.references)

    def __str__(self) -> str:
        """Return one line for each reference."""
        return "\n".join(map(str, self.references))


@cache
def references() -> tuple[Reference, ...]:
    """Return all references of the program; the first is the program itself."""
    text = resources.files("roughcontact.citing").joinpath("references.bib").read_text(encoding="utf-8")
    found = []
    for kind, key, body in _ENTRY.findall(text):
        fields = dict(_FIELD.findall(body))
        keywords = frozenset(fields.pop("keywords", "").split(", "))
        if "always" in keywords:
            fields["note"] = f"version {__version__}"
        found.append(Reference(key, kind, fields, keywords))
    return tuple(found)


def _people(names: str) -> str:
    """Return ``"Hertz, H. and Love, A. E. H."`` as ``"H. Hertz and A. E. H. Love"``."""
    *others, last = [" ".join(reversed(name.split(", "))) for name in names.split(" and ")]
    return f"{', '.join(others)} and {last}" if others else last
