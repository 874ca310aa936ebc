"""The pages about the thesis, of what `pages.py` reads: findings and claims, figures, and former verdicts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from roughcontact_thesis.ruling import INSIDE, OUTSIDE, RANGES, VICINITY
from roughcontact_thesis.verdict import Verdict

PICTURE = "fig27"  # beside the findings
FINDINGS = ("fig27", "fig28", "fig26", "fig37", "outlook-flat")  # in this order
_KINDS = {
    "claim": ("Claims", "What the thesis says about rough contacts."),
    "method": ("Definitions and methods", "What its derivations and its programs stand on."),
    "misprint": (
        "Numbers and formulae as printed",
        "Here a wrong one does not hold. The right ones, and a test for each, stand in [errata.md](errata.md).",
    ),
    "theory": ("Theories of others", "Models that the thesis reports, and what it says of them."),
    "answer": (
        "Questions of the thesis",
        "What it leaves open, put to ensembles: what it expects, and what is found.",
    ),
}
_MANY = {
    "holds": "hold",
    "holds in part": "hold in part",
    "does not hold": "do not hold",
    "not decided": "are not decided",
}


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
        return f"{'Figure' if self.name.startswith('fig') else 'Outlook,'} {self.short}"

    @property
    def anchor(self) -> str:
        """Where links to its section go."""
        return self.heading.lower().replace(",", "").replace(" ", "-")

    @property
    def mark(self) -> str:
        """What is to be said about its scale behind its number."""
        return {"small": ", small scale", "other": ", other counts"}.get(self.scale or "", "")


HEAD = """# The thesis, computed again

R. Pohrt, *Normal Stiffness of Multiscale Rough Surfaces in Elastic Contact* (TU Berlin, 2013), says that a rough square
pressed into an elastic half-space has a contact stiffness that grows as a power of the force, and that the exponent is
1/(H + 1), H the Hurst exponent of its roughness. Here its figures are computed anew, and its claims are judged by them.
Larger ensembles, the same surfaces on many grids, and a formula with errors: [law.md](law.md).
"""

RULES = f"""## How claims are judged

* A claim is quoted word for word, with section or equation, and has a tolerance that was fixed before.
* A deviation d with standard error s lies inside of a tolerance where |d| + {INSIDE} s does not exceed it, outside
  where |d| - {OUTSIDE} s does. A claim *holds* if all its deviations lie inside. If some lie outside, it *holds in
  part* where those inside make up a range, which is named, else it *does not hold*. Where errors let neither be said
  it is *not decided*. What is computed without a random surface has no s.
* The thesis expects deviations "in the vicinity of" H = 0 and H = 2. Vicinity is {VICINITY:g}: claims about 0 < H < 2
  are judged from {VICINITY:g} to {2 - VICINITY:g}, and all ranges ({", ".join(RANGES)}) are told, each with its own
  verdict.
* Values along H may share their random phases. The error of a difference between them is taken as the sum of both, its
  upper bound, also between grids and laws of the same surfaces: a verdict that needs a smaller one is not decided.
* A claim that the ensemble of its figure leaves open is judged by a larger one of [law.md](law.md), where there is
  one, with the same tolerance, and by the errors of differences as drawing surfaces again gives them; the last column
  says so.
* Averages over samples are arithmetic means at one force; power laws are fitted to their logarithms.

Every figure, with what was chosen and what it shows, stands in `reproduction/figures.md` of the repository. What became
of former verdicts stands in `reproduction/verdicts.md`.
"""

WORDS = """## Words and symbols

* E\\*: reduced modulus, 1/E\\* = (1 - nu1²)/E1 + (1 - nu2²)/E2. L: side of the square surface, or length of the line.
  h: rms height of its roughness. F, d, k: normal force, depth of indentation, contact stiffness dF/dd; K = -dF/du: the
  same against the mean gap u.
* F/(E\\* h L) and k/(E\\* L): force and stiffness without dimension. "A force of 0.07" is the former.
* H, D_f: Hurst exponent, and fractal dimension 3 - H. alpha, zeta: exponent and prefactor of the power law
  k/(E\\* L) = zeta (F/(E\\* h L))^alpha. q, C2D, C1D: wavenumber, power spectrum of a surface and of a line.
  Theta = h L^-H.
* Surfaces: rough squares, free at their edges, pressed into a half-space by boundary elements, square cells of constant
  pressure. Rough lines: N points pressed into a row of independent springs, the method of dimensionality reduction.
* 20 cells, 20 springs: twenty times the stiffness of a single one. Below, single ones decide, and nothing is fitted.
* Case: one solution, or one curve over all forces. Sample: one draw of the random phases, the same for all parameters.
  Sizes, rms heights and moduli of studies are bare numbers: what is found does not depend on them.

The package `roughcontact-thesis` draws the figures: `make thesis FIG=fig27` in a checkout, or, once it is installed,
`roughcontact thesis fig27`. `python reproduction/benchmarks/pages.py` writes this page.
"""

FIGURES = """# The figures of the thesis, computed again

What is found, every claim with its verdict, and the words and symbols stand in
[docs/evidence/reproduction.md](../docs/evidence/reproduction.md). `python reproduction/benchmarks/pages.py` writes
this page from files in [data](data): averages of ensembles, NetCDF files that also hold the studies they are
averages of, and the findings of figures that take seconds. The single solutions are not kept; the command in each
section makes them again, and all of them at once

    roughcontact thesis all --scale thesis --out DIR         # days; stopped at any time it goes on where it was
    python reproduction/benchmarks/pages.py --collect DIR
"""


def page(every: Sequence[Entry]) -> str:
    """Return the page of the documentation: what is found, and the claims in tables."""
    parts = [
        HEAD,
        *_findings(every),
        *_missing(every),
        RULES,
        *(line for kind in _KINDS for line in _table(every, kind)),
        WORDS,
    ]
    return "\n".join(parts)


def figures_page(every: Sequence[Entry], unjudged: dict[str, Any]) -> str:
    """Return the page of the figures: what is not judged, then a section for each."""
    return "\n".join([FIGURES, *_unjudged(unjudged), *(line for each in every for line in _section(each))])


def changes_page(every: Sequence[Entry], former: Sequence[dict[str, Any]]) -> str:
    """Return the page that lays former verdicts beside those of now."""
    anchors = {each.name: each for each in every}
    now = {(each.name, verdict.claim): verdict for each in every for verdict in each.verdicts}
    # Some claims are judged at another figure now.
    named = [(row.get("judged", row["figure"]), claim) for row in former for claim in row["now"]]
    new = [each for each in now if each not in named]
    lines = [
        "# Verdicts on the thesis, and what became of them",
        "",
        f"The {len(former)} rows on the left were judged by rules that were unfair to the thesis: limits of H at "
        "which it expects deviations counted against it, errors often had no part in the verdict, formulae were "
        "tested under numbers that are not theirs, and theories of others, misprints and questions stood among its "
        "claims. On the right the verdicts of now, by the rules of "
        "[reproduction.md](../docs/evidence/reproduction.md#how-claims-are-judged), and why they differ.",
        "",
        "| figure | before | verdict | now | verdict | why |",
        "|---|---|---|---|---|---|",
    ]
    for row in former:
        entry = anchors[row["figure"]]
        # What was not computed has no verdict.
        found = [now.get((row.get("judged", row["figure"]), claim)) for claim in row["now"]]
        words = "<br>".join(each.word if each else "missing" for each in found) or "no claim"
        claims = "<br>".join(map(plain, row["now"])) or "left out"
        lines.append(
            f"| [{entry.short}](figures.md#{entry.anchor}) | {plain(row['claim'])} | {row['word']} | "
            f"{claims} | {plain(words)} | {plain(row['why'])} |"
        )
    lines += ["", "## Claims that are new", "", "| figure | claim | verdict |", "|---|---|---|"]
    for name, claim in new:
        entry = anchors[name]
        word = plain(now[name, claim].word)
        lines.append(f"| [{entry.short}](figures.md#{entry.anchor}) | {plain(claim)} | {word} |")
    return "\n".join([*lines, ""])


def _findings(every: Sequence[Entry]) -> list[str]:
    told = {each.name: each for each in every}
    said = [told[name].finding for name in FINDINGS if name in told and told[name].finding]
    lines = ["## What is found", ""]
    if said:
        lines += [*(f"{n}. {each}" for n, each in enumerate(said, start=1)), ""]
    one = told.get(PICTURE)
    if one is not None and one.computed:
        lines += [f"![{one.title}](../../reproduction/pictures/{one.name}.png)", "", plain(one.caption), ""]
    return lines


def _missing(every: Sequence[Entry]) -> list[str]:
    lines = []
    for said, chosen in (
        ("**Missing**, not computed yet: {}.", [each for each in every if not each.computed]),
        (
            "On the small scale as yet, fewer samples on smaller grids than the thesis': {}. What these say is "
            "provisional.",
            [each for each in every if each.scale == "small"],
        ),
        (
            "With counts that are neither the thesis' nor small: {}.",
            [each for each in every if each.scale == "other"],
        ),
        ("Cases failed or are missing: {}.", [each for each in every if not each.whole]),
    ):
        if chosen:
            names = ", ".join(each.short for each in chosen)
            lines += [said.format(f"figure{'s' if len(chosen) > 1 else ''} {names}"), ""]
    return lines


def _table(every: Sequence[Entry], kind: str) -> list[str]:
    rows = [(each, verdict) for each in every for verdict in each.verdicts if verdict.kind == kind]
    if not rows:
        return []
    title, words = _KINDS[kind]
    counts = Counter(verdict.ruling.word for _, verdict in rows)
    told = ", ".join(f"{counts[word]} {_MANY[word]}" for word in _MANY if counts[word])
    lines = [
        f"## {title}",
        "",
        f"{words} Of {len(rows)}, {told}. What is found stands in `reproduction/figures.md`.",
        "",
    ]
    lines += [
        "| figure | claim | the thesis | judged by | verdict | what decided |",
        "|---|---|---|---|---|---|",
    ]
    for each, verdict in rows:
        rule = verdict.ruling
        word = f"**{rule.words}**" if rule.word == "does not hold" else rule.words
        judged = ", ".join(filter(None, (rule.tolerance, rule.span)))
        cells = (verdict.claim, f"“{verdict.quote}” ({verdict.source})", judged)
        lines.append(
            f"| {each.short}{each.mark} | {' | '.join(map(plain, cells))} | {word} | {plain(rule.trigger)} |"
        )
    return [*lines, ""]


def _unjudged(words: dict[str, Any]) -> list[str]:
    lines = ["## What is not judged", "", "| claim | where | why not |", "|---|---|---|"]
    lines += [
        f"| {plain(each['claim'])} | {plain(each['where'])} | {each['why']} |" for each in words["claims"]
    ]
    lines += ["", "Figures of the thesis that are not drawn:", "", "| figure | what it is | why not |"]
    lines += ["|---|---|---|"]
    lines += [f"| {each['figure']} | {plain(each['what'])} | {each['why']} |" for each in words["figures"]]
    return [*lines, ""]


_SCALES = {
    "thesis": "On the scale of the thesis, with its counts where it states them:",
    "small": "**On the small scale**, fewer samples on smaller grids than the thesis':",
    "other": "**With counts that are not those of the figure now**:",
    None: "Computed in seconds:",
}


def _section(entry: Entry) -> list[str]:
    lines = [f"## {entry.heading}", "", f"**{plain(entry.title[0].upper() + entry.title[1:])}**", ""]
    if not entry.computed:
        return [*lines, f"**Missing:** not computed yet; {command(entry.name, 'thesis')} does it.", ""]
    lines += [f"![{entry.title}](pictures/{entry.name}.png)", "", plain(entry.caption), ""]
    if entry.verdicts:
        lines += [
            f"* **{plain(verdict.word[0].upper() + verdict.word[1:])}:** {plain(verdict.claim)}. "
            f"*Here:* {plain(verdict.found)}."
            for verdict in entry.verdicts
        ]
    else:
        lines.append("The text makes no claim about it that could be judged.")
    lines += ["", "Chosen where the thesis leaves it open:", "", *_items(map(plain, entry.chosen))]
    lines += ["", _SCALES[entry.scale], "", *_items(entry.computed)]
    if entry.scale is not None:
        lines.append(f"* averages: [{entry.name}.nc](data/{entry.name}.nc)")
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
