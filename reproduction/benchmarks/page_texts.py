"""The pages of the figures of the thesis and of former verdicts, of what `pages.py` reads."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from roughcontact_thesis.verdict import Verdict


@dataclass(frozen=True)
class Entry:
    """What the page says about a figure.

    Parameters
    ----------
    name : str
        Such as ``fig27``.
    title, caption : str
        What it is, and what is seen in it.
    chosen : tuple of str
        What the thesis leaves open, and what is taken here.
    computed : tuple of str
        How it was computed, a line each; none where it was not.
    scale : str or None
        Of an ensemble: ``thesis``, ``small``, or ``other`` where it is neither; None without an ensemble.
    whole : bool
        Whether no case failed or is missing.
    verdicts : tuple of Verdict
    finding : str
        What it says about the whole, in a sentence; empty for most.
    """

    name: str
    title: str
    caption: str
    chosen: tuple[str, ...]
    computed: tuple[str, ...]
    scale: str | None
    whole: bool
    verdicts: tuple[Verdict, ...]
    finding: str = ""

    @property
    def short(self) -> str:
        """The number of the figure, or the word of a question of the outlook."""
        return self.name.removeprefix("fig").removeprefix("outlook-")

    @property
    def heading(self) -> str:
        """What its section is called."""
        return _heading(self.short)

    @property
    def link(self) -> str:
        """Where its section is, from the folder of this package."""
        return f"../docs/evidence/reproduction-figures.md#{anchor(self.short)}"

    @property
    def mark(self) -> str:
        """What is to be said about its scale behind its number."""
        return {"small": ", small scale", "other": ", other counts"}.get(self.scale or "", "")


FIGURES = """# The thesis, computed again: the figures

The findings, and the words and symbols, are on the [first page](reproduction.md); [all claims](reproduction-claims.md)
has every verdict. `python reproduction/benchmarks/pages.py` writes this page from the files in `reproduction/data`.
Averages of ensembles are NetCDF files that also contain their studies. The results of figures that take seconds are in
`simple.json`. Single solutions are not stored. The command in each section
computes them again, and these commands compute all of them:

    roughcontact thesis all --scale thesis --out DIR         # days; may be stopped at any time and continued
    python reproduction/benchmarks/pages.py --collect DIR
"""


def _heading(short: str) -> str:
    """Return what the section of a figure is called, by its number or the word of a question of the outlook."""
    return f"Figure {short}" if short.isdigit() else f"Outlook, {short}"


def anchor(short: str) -> str:
    """Return where links to the section of a figure go."""
    return _heading(short).lower().replace(",", "").replace(" ", "-")


def figures_page(every: Sequence[Entry], unjudged: dict[str, Any]) -> str:
    """Return the page of the figures: what is not judged, then a section for each."""
    return "\n".join([FIGURES, *_unjudged(unjudged), *(line for each in every for line in _section(each))])


def changes_page(
    every: Sequence[Entry],
    former: Sequence[dict[str, Any]],
    first: Sequence[dict[str, str]],
    changed: Sequence[dict[str, Any]],
) -> str:
    """Return the page of former verdicts: what changed since the `first` edition, and what had before it."""
    entries = {each.name: each for each in every}
    now = {(each.name, verdict.claim): verdict for each in every for verdict in each.verdicts}
    before = {(row["figure"], row["claim"]): row for row in first}

    def listed(claims: Sequence[str], words: Sequence[str], nothing: tuple[str, str]) -> str:
        cells = (
            "<br>".join(map(plain, each)) or other
            for each, other in zip((claims, words), nothing, strict=True)
        )
        return " | ".join(cells)

    def present(figure: str, claims: Sequence[str]) -> str:
        # What was not computed has no verdict.
        found = [now.get((figure, claim)) for claim in claims]
        return listed(claims, [each.word if each else "missing" for each in found], ("left out", "no claim"))

    lines = [
        "# Former verdicts on the thesis",
        "",
        "The rules are those of [reproduction.md](../docs/evidence/reproduction.md#how-claims-are-judged).",
        "",
        "## Changes since the first edition",
        "",
        f"The first edition had {len(first)} verdicts. The table lists those that changed, with the reason. All others "
        'are as they were. "Moved" means that the verdict is the same, in another table of the page. No tolerance '
        "changed. The range of H changed for one claim, and the reason gives what is left out.",
        "",
        "| figure | before | verdict | now | verdict | why |",
        "|---|---|---|---|---|---|",
    ]
    for row in changed:
        entry = entries[row["figure"]]
        words = [before[row["figure"], claim]["verdict"] for claim in row["before"]]
        old = listed(row["before"], words, ("new", ""))
        new = present(row["figure"], row["now"])
        lines.append(f"| [{entry.short}]({entry.link}) | {old} | {new} | {plain(row['why'])} |")
    lines += [
        "",
        "## Changes before the first edition",
        "",
        f"The {len(former)} rows on the left were judged by rules that were unfair to the thesis. Deviations counted "
        "against it even at limits of H where it expects them. The verdict often ignored errors. Formulae were tested "
        "under the wrong numbers. Theories of others, misprints and questions were listed among its claims. The right "
        "half of the table gives the present verdicts.",
        "",
        "| figure | before | verdict | now | verdict | why |",
        "|---|---|---|---|---|---|",
    ]
    for row in former:
        entry = entries[row["figure"]]
        # Some claims are judged at another figure now.
        new = present(row.get("judged", row["figure"]), row["now"])
        lines.append(
            f"| [{entry.short}]({entry.link}) | {plain(row['claim'])} | {row['word']} | {new} | {plain(row['why'])} |"
        )
    return "\n".join([*lines, ""])


def _unjudged(words: dict[str, Any]) -> list[str]:
    lines = ["## Claims that are not judged", "", "| claim | where | reason |", "|---|---|---|"]
    lines += [
        f"| {plain(each['claim'])} | {plain(each['where'])} | {each['why']} |" for each in words["claims"]
    ]
    lines += ["", "Figures of the thesis that are not drawn:", "", "| figure | content | reason |"]
    lines += ["|---|---|---|"]
    lines += [f"| {each['figure']} | {plain(each['what'])} | {each['why']} |" for each in words["figures"]]
    return [*lines, ""]


_SCALES = {
    "thesis": "On the scale of the thesis, with its counts where it states them:",
    "small": "**On the small scale**, with fewer samples and smaller grids than the thesis:",
    "other": "**With counts other than those of the figure**:",
    None: "Computed in seconds:",
}


def _section(entry: Entry) -> list[str]:
    lines = [f"## {entry.heading}", "", f"**{plain(entry.title[0].upper() + entry.title[1:])}**", ""]
    if not entry.computed:
        return [*lines, f"**Missing:** not computed yet; {command(entry.name, 'thesis')} computes it.", ""]
    lines += [f"![{entry.title}](../../reproduction/pictures/{entry.name}.png)", "", plain(entry.caption), ""]
    if entry.verdicts:
        lines += [
            f"* **{plain(verdict.word[0].upper() + verdict.word[1:])}:** {plain(verdict.claim)}. "
            f"*Here:* {plain(verdict.found)}."
            for verdict in entry.verdicts
        ]
    else:
        lines.append("The text makes no claim about this figure that could be judged.")
    lines += ["", "Choices that the thesis leaves open:", "", *_items(map(plain, entry.chosen))]
    lines += ["", _SCALES[entry.scale], "", *_items(entry.computed)]
    if entry.scale is not None:
        lines.append(f"* averages: [{entry.name}.nc](../../reproduction/data/{entry.name}.nc)")
    return [*lines, ""]


def _items(words: Iterable[str]) -> list[str]:
    return [f"* {each}" for each in words]


def command(name: str, scale: str | None) -> str:
    """Return the command that computes a figure."""
    return (
        f"`roughcontact thesis {name}{f' --scale {scale}' if scale in ('thesis', 'small') else ''} --out DIR`"
    )


def plain(words: str) -> str:
    """Return words as they are, whatever Markdown makes of their signs."""
    for sign in "\\|*[]":
        words = words.replace(sign, f"\\{sign}")
    return words
