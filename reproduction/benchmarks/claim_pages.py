"""The page of the findings about the thesis and the page of its claims, of what `pages.py` reads."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Sequence

from page_texts import Entry, anchor, plain

from roughcontact_thesis.ruling import INSIDE, OUTSIDE, RANGES, VICINITY

PICTURE = "fig27"  # beside the findings
FINDINGS = ("fig27", "fig28", "fig26", "fig37", "outlook-flat")  # in this order
DOZEN = {  # the claims of the first page, as their rows are called, and in words for readers of this page only
    "alpha = 1/(H + 1) for surfaces": "the stiffness of a rough square grows as F^(1/(H + 1))",
    "k = 1.7/(H + 1) F^(1/(H + 1)), the whole law": "k/(E* L) = 1.7/(H + 1) (F/(E* h L))^(1/(H + 1)) is that stiffness",
    "the shape of the square plays no role at low loads": "that the surface is a square plays no role at low loads",
    "exponents of surfaces and of lines match": "rough lines on independent springs have the same exponents",
    "the exponent of Hertz for surfaces above H = 2": "above H = 2 k grows as F^(1/3), as on one smooth crest",
    "it depends on the number of scales, not on the forces of the fit": "for H of about 0 and less, the exponent "
    "depends on the number of scales of the roughness",
    "the stiffness of surfaces scatters by about 30 % at most": "single surfaces scatter by about 30 % at most",
    "the stiffness does not see the smallest scales": "the smallest scales do not change the stiffness",
    "at a given Theta and force a square of four times the side has the same stiffness": "the size of the square does "
    "not change the stiffness at a given force and Theta = h L^-H (here: four times the side)",
    "sphere and roughness act as their forces added": "a rough sphere acts as sphere and roughness with forces added",
    "with a cut-off the stiffness is proportional to the force": "without long waves, as on nominally flat surfaces, "
    "the stiffness is proportional to the force",
    "k/k_t = (2 - nu)/(2(1 - nu)) on rough surfaces": "normal over tangential stiffness is that of a circular contact",
}
_KINDS = {
    "claim": ("Claims", "Statements of the thesis about rough contacts."),
    "assumption": (
        "Assumptions",
        "Assumptions that the thesis states as such, to derive a law for flat surfaces.",
    ),
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


HEAD = """# The thesis, computed again

R. Pohrt, *Normal Stiffness of Multiscale Rough Surfaces in Elastic Contact* (TU Berlin, 2013), studies a rough square
that is pressed into an elastic half-space. The surface is self-affine: magnified by lambda along the surface and by
lambda^H in height, it looks the same. H is its Hurst exponent: the smaller H, the rougher the small scales. According
to the thesis, the contact stiffness k grows with the force F as k ~ F^(1/(H + 1)). This page shows which of its claims
hold, for readers who have not read it. The [symbols](#words-and-symbols) are at the end.

* [All claims](reproduction-claims.md): every claim, quoted, with its verdict in each range of H.
* [The figures](reproduction-figures.md): every figure of the thesis, computed again, with all choices and results.
* [The law of rough squares](law.md): larger ensembles, and a formula with errors. [Errata](errata.md): misprints.
* `reproduction/verdicts.md` in the repository lists former verdicts, and the reason of each change.
"""

RULES = f"""## How claims are judged

* A claim is quoted word for word, with section or equation. Its tolerance was fixed before the computation. Claims that
  were added later have the tolerance of similar claims.
* A deviation d with standard error s lies inside the tolerance if |d| + {INSIDE} s does not exceed it, and outside if
  |d| - {OUTSIDE} s exceeds it. Results that need no random surface have no s.
* A claim *holds* if all its deviations lie inside. If some lie outside and those inside form a range, it *holds in
  part*, and the range is named. If some lie outside and none inside, it *does not hold*. In all other cases it is
  *not decided*.
* The column "decided by" lists the deviation that decided: the largest one, one outside the tolerance, or an
  undecided one.
* The thesis expects deviations "in the vicinity of" H = 0 and H = 2. The vicinity is taken as {VICINITY:g}: claims
  about 0 < H < 2 are judged from {VICINITY:g} to {2 - VICINITY:g}. [All claims](reproduction-claims.md) lists the
  results for each range ({", ".join(RANGES)}),
  with separate verdicts.
* What the thesis introduces as an assumption is judged in a separate table, not among its claims.
* Values at different H may share their random phases. The error of a difference between them is taken as the sum of
  both errors, its upper bound. The same holds for different grids and laws of the same surfaces. A verdict that needs
  a smaller error is not decided.
* If the ensemble of a figure does not decide a claim, a larger ensemble of [law.md](law.md) judges it, if there is
  one. The tolerance is the same. The errors of differences come from resampling the surfaces. The column "decided by"
  then gives the number of its surfaces.
* Averages over samples are arithmetic means at one force. Power laws are fitted to their logarithms.
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
`roughcontact thesis fig27` once the package is installed. `python reproduction/benchmarks/pages.py` writes
these pages.
"""

CLAIMS = f"""# The thesis, computed again: all claims

<!-- tables of ../data/reproduction/claims.csv -->

This page lists every claim of the thesis that is judged, quoted word for word. The
[first page](reproduction.md) has the findings, the [rules](reproduction.md#how-claims-are-judged) and the
[symbols](reproduction.md#words-and-symbols). The number of a figure leads to its picture and all results. Five
columns give verdict and deviations in each range of H that is computed; a claim about 0 < H < 2 is judged from
{VICINITY:g} to {2 - VICINITY:g}. All rows are in one [data file](../data/reproduction/claims.csv), from which these
tables are made.
"""
COLUMNS = (
    "kind",
    "figure",
    "claim",
    "quote",
    "source",
    "tolerance",
    "judged for",
    "verdict",
    "where",
    "decided by",
)
_IN_RANGE = {f"H {name}": name for name in RANGES}


def claims_file(every: Sequence[Entry]) -> str:
    """Return every verdict as a row of a data file, by kinds."""
    text = io.StringIO()
    table = csv.DictWriter(text, [*COLUMNS, *_IN_RANGE], lineterminator="\n")
    table.writeheader()
    rows = [(each, verdict) for each in every for verdict in each.verdicts]
    for each, verdict in sorted(rows, key=lambda row: [*_KINDS].index(row[1].kind)):
        rule = verdict.ruling
        cells = (
            *(verdict.kind, each.short + each.mark, verdict.claim, verdict.quote, verdict.source),
            *(rule.tolerance, rule.span, rule.word, rule.part, rule.trigger),
        )
        found = {column: rule.ranges.get(name, "") for column, name in _IN_RANGE.items()}
        table.writerow(dict(zip(COLUMNS, cells, strict=True)) | found)
    return text.getvalue()


def claims_page(data: str) -> str:
    """Return the page of all claims, of a data file."""
    rows = [*csv.DictReader(io.StringIO(data))]
    return "\n".join([CLAIMS, *(line for kind in _KINDS for line in _table(rows, kind))])


def page(every: Sequence[Entry]) -> str:
    """Return the first page: findings, a picture, a dozen claims, rules and symbols."""
    return "\n".join([HEAD, *_findings(every), *_missing(every), *_dozen(every), RULES, WORDS])


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


def _dozen(every: Sequence[Entry]) -> list[str]:
    found = {verdict.claim: (each, verdict) for each in every for verdict in each.verdicts}
    lines = [
        "## A dozen claims",
        "",
        "| claim of the thesis | verdict | decided by | figure |",
        "|---|---|---|---|",
    ]
    for claim, words in DOZEN.items():
        if claim in found:
            each, verdict = found[claim]
            rule = verdict.ruling
            cells = (words, rule.words, ", for ".join(filter(None, (rule.trigger, rule.span))))
            lines.append(f"| {' | '.join(map(plain, cells))} | {_link(each.short)} |")
    return [*lines, ""]


def _link(short: str) -> str:
    """Return a link to the section of a figure."""
    return f"[{short}](reproduction-figures.md#{anchor(short.partition(',')[0])})"


def _table(every: Sequence[dict[str, str]], kind: str) -> list[str]:
    rows = [row for row in every if row["kind"] == kind]
    if not rows:
        return []
    title, words = _KINDS[kind]
    counts = Counter(row["verdict"] for row in rows)
    told = ", ".join(f"{counts[word]} {_MANY[word]}" for word in _MANY if counts[word])
    ranges = [column for column in _IN_RANGE if any(row[column] for row in rows)]
    head = ["figure", "claim", "verdict", *ranges, "decided by", "tolerance", "the thesis"]
    lines = [f"## {title}", "", f"{words} Of {len(rows)}, {told}.", ""]
    lines += [f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
    for row in rows:
        word = f"{row['verdict']} ({row['where']})" if row["where"] else row["verdict"]
        cells = (
            word,
            *(row[column] for column in ranges),
            row["decided by"],
            ", ".join(filter(None, (row["tolerance"], row["judged for"]))),
            f"“{row['quote']}” ({row['source']})",
        )
        claim, verdict, *rest = map(plain, (row["claim"], *cells))
        verdict = f"**{verdict}**" if word == "does not hold" else verdict
        lines.append(f"| {_link(row['figure'])} | {' | '.join((claim, verdict, *rest))} |")
    return [*lines, ""]
