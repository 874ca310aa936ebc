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
    "claim": ("Claims", "Statements of the thesis about rough contacts."),
    "method": ("Definitions and methods", "Statements on which its derivations and its programs are based."),
    "misprint": (
        "Numbers and formulae as printed",
        "A wrong one does not hold. [errata.md](errata.md) lists the right ones, with a test for each.",
    ),
    "theory": ("Theories of others", "Models that the thesis reports, and its statements about them."),
    "answer": (
        "Questions of the thesis",
        "Open questions of the thesis, studied with ensembles: its expectations and the results.",
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

R. Pohrt, *Normal Stiffness of Multiscale Rough Surfaces in Elastic Contact* (TU Berlin, 2013), studies a rough square
that is pressed into an elastic half-space. According to the thesis, its contact stiffness grows as a power of the
force with the exponent 1/(H + 1), where H is the Hurst exponent of its roughness. On this page the figures of the
thesis are computed again, and its claims are judged by them. [law.md](law.md) describes larger ensembles, the same
surfaces on many grids, and a formula with errors.
"""

RULES = f"""## How claims are judged

* A claim is quoted word for word, with section or equation. Its tolerance was fixed before the computation.
* A deviation d with standard error s lies inside the tolerance if |d| + {INSIDE} s does not exceed it, and outside if
  |d| - {OUTSIDE} s exceeds it. Results that need no random surface have no s.
* A claim *holds* if all its deviations lie inside. If some lie outside and those inside form a range, it *holds in
  part*, and the range is named. If some lie outside and none inside, it *does not hold*. In all other cases it is
  *not decided*.
* The last column gives the deviation that decided: the largest one, one outside the tolerance, or an undecided one.
* The thesis expects deviations "in the vicinity of" H = 0 and H = 2. The vicinity is taken as {VICINITY:g}: claims
  about 0 < H < 2 are judged from {VICINITY:g} to {2 - VICINITY:g}. The results for all ranges ({", ".join(RANGES)})
  are listed, each with a separate verdict.
* Values at different H may share their random phases. The error of a difference between them is taken as the sum of
  both errors, its upper bound. The same holds for different grids and laws of the same surfaces. A verdict that needs
  a smaller error is not decided.
* If the ensemble of a figure does not decide a claim, a larger ensemble of [law.md](law.md) judges it, if there is
  one. The tolerance is the same. The errors of differences come from resampling the surfaces. The last column then
  names this ensemble.
* Averages over samples are arithmetic means at one force. Power laws are fitted to their logarithms.

`reproduction/figures.md` in the repository shows every figure, with the choices made and the results.
`reproduction/verdicts.md` compares former verdicts with these.
"""

WORDS = """## Words and symbols

* E\\*: reduced modulus, 1/E\\* = (1 - nu1²)/E1 + (1 - nu2²)/E2. L: side of the square surface, or length of the line.
  h: rms height of its roughness.
* F, d, k: normal force, indentation depth, contact stiffness dF/dd. K = -dF/du: stiffness against the mean gap u.
* F/(E\\* h L) and k/(E\\* L): dimensionless force and stiffness. "A force of 0.07" means F/(E\\* h L) = 0.07.
* H, D_f: Hurst exponent, and fractal dimension 3 - H. alpha, zeta: exponent and prefactor of the power law
  k/(E\\* L) = zeta (F/(E\\* h L))^alpha. q, C2D, C1D: wavenumber, power spectrum of a surface and of a line.
  Theta = h L^-H.
* Surfaces: rough squares, free at their edges, pressed into a half-space by boundary elements, square cells of constant
  pressure. Rough lines: N points pressed into a row of independent springs, the method of dimensionality reduction.
* 20 cells, 20 springs: twenty times the stiffness of a single cell or spring. Below this stiffness the result depends
  on single cells, and no law is fitted.
* Case: one solution, or one curve over all forces. Sample: one draw of the random phases, the same for all parameters.
* Sizes, rms heights and moduli of studies have no units, because the results do not depend on them.

The package `roughcontact-thesis` draws the figures: run `make thesis FIG=fig27` in a checkout, or
`roughcontact thesis fig27` once the package is installed. `python reproduction/benchmarks/pages.py` writes this page.
"""

FIGURES = """# The figures of the thesis, computed again

The results, every claim with its verdict, and the words and symbols are in
[docs/evidence/reproduction.md](../docs/evidence/reproduction.md). `python reproduction/benchmarks/pages.py` writes
this page from the files in [data](data). Averages of ensembles are NetCDF files that also contain their studies. The
results of figures that take seconds are in `simple.json`. Single solutions are not stored. The command in each section
computes them again, and these commands compute all of them:

    roughcontact thesis all --scale thesis --out DIR         # days; may be stopped at any time and continued
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
        "# Verdicts on the thesis, before and now",
        "",
        f"The {len(former)} rows on the left were judged by rules that were unfair to the thesis. Deviations counted "
        "against it even at limits of H where it expects them. The verdict often ignored errors. Formulae were tested "
        "under the wrong numbers. Theories of others, misprints and questions were listed among its claims. The right "
        "half of the table gives the present verdicts, by the rules of "
        "[reproduction.md](../docs/evidence/reproduction.md#how-claims-are-judged), and the reason for a difference.",
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
    lines += ["", "## New claims", "", "| figure | claim | verdict |", "|---|---|---|"]
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
            "On the small scale, with fewer samples and smaller grids than the thesis: {}. These results are "
            "provisional.",
            [each for each in every if each.scale == "small"],
        ),
        (
            "With counts that are neither those of the thesis nor those of the small scale: {}.",
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
        f"{words} Of {len(rows)}, {told}. The results are in `reproduction/figures.md`.",
        "",
    ]
    lines += [
        "| figure | claim | the thesis | tolerance | verdict | deviation that decided |",
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
    lines += [f"![{entry.title}](pictures/{entry.name}.png)", "", plain(entry.caption), ""]
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
