"""Find words and turns of phrase that this project does not use, in its pages and in the texts of its code.

python .ci/prose.py              fail if a file has more findings than prose_left.toml allows, or fewer
python .ci/prose.py PATH ...     print all findings in these files or folders
python .ci/prose.py --lower      lower the numbers in prose_left.toml to what is found; no number is raised

Code is parsed: docstrings, comments, and the strings that hold a space are texts, names are not.
"""

from __future__ import annotations

import ast
import io
import re
import sys
import tokenize
import tomllib
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

HOME = Path(__file__).parent.parent
LEFT = Path(__file__).with_name("prose_left.toml")
PLACES = ("*.md", "docs/**/*.md", "docs/**/*.csv", "examples/**/*.py", "examples/**/*.rst", "src/**/*.py")
PAGE = ("src/**/static/*.js", "src/**/static/*.html")
MOST = 20  # lines of what is wrong
# What the build of the site writes.
MADE = re.compile(r"docs/(gallery|api)/|docs/project/[A-Z]")

# Words after which "own" is no adjective, as it is in "of your own file".
AFTER = "and|are|as|at|beside|by|for|from|has|have|in|is|of|on|or|that|to|which|while|with"
# What is found, by which pattern in a paragraph that has become one line, and what to write.
RULES = (
    ("tell", r"\b(tells?|told|telling)\b", "programs print, report, raise, return, warn"),
    ("say", r"\b(says|said|saying)\b", "programs print, pages state, numbers show"),
    ("know", r"\b(knows|knew)\b", "programs hold, read, support"),
    ("want", r"\bwants\b", "programs need, require, take"),
    ("forget", r"\b(forgets?|remembers|believes|thinks|speaks)\b", "programs drop, keep, assume, print"),
    ("who", r"\b(nobody|whoever)\b", "name the process, the thread or the user"),
    ("hardly", r"\bhardly\b", "rarely, almost never, almost no"),
    ("but for", r"\bbut for\b", "except"),
    (
        "so many",
        r"\bso many\b(?! \S+ that\b)|(?<!twice )(?<!times )(?<!half )\bas many as\b",
        "n; the first n; the number of",
    ),
    (
        "none",
        r"\b((?<!there )(is|are|was|were)|as good as) none\b(?! of)",
        "is missing, invalid, NaN, not a ...",
    ),
    ("no number", r"\bno number\b", "NaN, missing, not a number"),
    ("what there is", r"\bwhat (there (is|are|was|were)\b|is (not|so)\b(?![.,;:]))", "name the thing"),
    ("is to be", r"\b(is|are|was|were)( not)? to be\b", "can, must, will; say who does it"),
    ("is meant", r"\b(is|are) meant\b(?! (to|for|as)\b)", "which is computed, used, read"),
    ("all of it", r"\ball of it\b", "name the thing"),
    (
        "of its own",
        rf"\bof (its|their|our|your|one's) own\b(?! (?!({AFTER})\b)\w)",
        "its, separate, a second; or drop it",
    ),
    ("lets expect", r"\blets? expect\b", "as expected from, as predicted by"),
    (
        "alone",
        r"(?<!\bstand )(?<!\bstands )(?<!\blet )(?<!\bleave )(?<!\bstanding )\balone\b",
        "only, before the noun",
    ),
    ("else", r"(^|[,;.] )[Ee]lse\b", "otherwise"),
    ("inverted", r"(^|[.:;] )Of (an?|the|these|those|this|what|which|each|such) ", "subject, verb, object"),
    (
        "idiom",
        r"\b(all told|hangs? on|its say|as dear|is dear|for ever|anew|as good as(?! none)|to speak of|of this world)\b",
        "the ordinary word",
    ),
)
# Where such words are right: file, the words as they stand there, and why.
EXCEPT: tuple[tuple[str, str, str], ...] = (
    ("src/roughcontact/page/static/index.html", 'id="said"', "a name"),
    ("src/roughcontact/page/static/form.js", "${alone ?", "a name"),
)

_BLANK = re.compile(r"[^\n]")
_FENCE = re.compile(r"^([ \t]*)```.*?^\1```", re.DOTALL | re.MULTILINE)
_CODE = re.compile(
    r"^ *(?:>>>|\.\.\.).*$|``.*?``|`[^`\n]*`|<!--.*?-->|\]\([^)\s]*\)", re.DOTALL | re.MULTILINE
)
_SCRIPT_TEXT = re.compile(r'"[^"\n]*"|`[^`]*`|//[^\n]*|/\*.*?\*/', re.DOTALL)
_PATTERNS = [(name, re.compile(pattern), advice) for name, pattern, advice in RULES]


class Finding(NamedTuple):
    """A word that is not used here: the line, the rule, the words around it, and what to write."""

    line: int
    rule: str
    words: str
    advice: str


def blank(text: str) -> str:
    """Return as many spaces, on the same lines."""
    return _BLANK.sub(" ", text)


def comments(text: str) -> str:
    """Keep only the comments of code, on the same lines."""
    return "\n".join(
        blank(before) + mark + after for before, mark, after in (x.partition("#") for x in text.split("\n"))
    )


def prose(text: str) -> str:
    """Return a text with its code, links and remarks blanked; comments of blocks of code stay."""
    return _CODE.sub(lambda found: blank(found[0]), _FENCE.sub(lambda found: comments(found[0]), text))


def python_texts(source: str) -> Iterator[tuple[int, str]]:
    """Yield the first line and the text of every string and every block of comments of a module."""
    inside = set()  # the pieces of f-strings, which are put together
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.JoinedStr):
            inside |= {id(each) for each in node.values}
            pieces = [each.value if isinstance(each, ast.Constant) else "{}" for each in node.values]
            yield node.lineno, prose("".join(map(str, pieces)))
        elif isinstance(node, ast.Constant) and id(node) not in inside and " " in str(node.value):
            yield node.lineno, prose(str(node.value))
    lines: dict[int, str] = {}
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            lines[token.start[0]] = token.string.lstrip("#")
    for start in [line for line in lines if line - 1 not in lines]:
        end = next(line for line in range(start, start + len(lines) + 1) if line not in lines)
        yield start, prose("\n".join(lines[line] for line in range(start, end)))


def texts(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the texts of a file, each with its first line."""
    source = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        yield from python_texts(source)
    elif path.suffix == ".js":
        for found in (each for each in _SCRIPT_TEXT.finditer(source) if " " in each[0]):
            yield source.count("\n", 0, found.start()) + 1, found[0].lstrip("/* ")
    else:
        yield 1, prose(source)


def paragraphs(path: Path) -> Iterator[tuple[str, list[int]]]:
    """Yield the paragraphs of a file as one line each, with the line of the file that each word is on."""
    for first, text in texts(path):
        words: list[str] = []
        numbers: list[int] = []
        for number, line in enumerate([*text.split("\n"), ""], first):
            if line.strip():
                words += line.split()
                numbers += [number] * len(line.split())
            elif words:
                yield " ".join(words), numbers
                words, numbers = [], []


def findings(path: Path) -> list[Finding]:
    """Return what is found in a file, in the order of its lines."""
    allowed = [words for file, words, _ in EXCEPT if file == relative(path)]
    found = []
    for text, numbers in paragraphs(path):
        for words in allowed:
            text = text.replace(words, " ".join("-" for _ in words.split()))
        for name, pattern, advice in _PATTERNS:
            for match in pattern.finditer(text):
                line = numbers[len(text[: match.end()].split()) - 1]
                found.append(Finding(line, name, text[max(0, match.start() - 40) : match.end() + 40], advice))
    return sorted(found)


def relative(path: Path) -> str:
    """Return a path as seen from the root of the checkout."""
    return path.relative_to(HOME).as_posix()


def files() -> list[Path]:
    """Return the files that are looked at."""
    every = {path for place in (*PLACES, *PAGE) for path in HOME.glob(place)}
    return sorted(path for path in every if not MADE.match(relative(path)))


def stale() -> list[str]:
    """Return the exceptions whose words are gone."""
    gone = []
    for file, words, _ in EXCEPT:
        path = HOME / file
        if not path.exists() or not any(words in text for text, _ in paragraphs(path)):
            gone.append(f"{file}: {words!r} is not there any longer: remove the exception")
    return gone


def left() -> dict[str, int]:
    """Return how many findings every file may have, as was written."""
    return tomllib.loads(LEFT.read_text(encoding="utf-8"))["left"] if LEFT.exists() else {}


def compared(counts: dict[str, int], allowed: dict[str, int]) -> list[str]:
    """Return in which files there are more findings than allowed, or fewer."""
    wrong = []
    for file in sorted(counts.keys() | allowed.keys()):
        now, before = counts.get(file, 0), allowed.get(file, 0)
        if now > before:
            wrong.append(f"{file}: {now} findings, {before} allowed; to see them: python .ci/prose.py {file}")
        elif now < before:
            wrong.append(
                f"{file}: {now} findings, {before} allowed; to lower that: python .ci/prose.py --lower"
            )
    return wrong


def lower(counts: dict[str, int]) -> None:
    """Write what is left; no number grows, unless none has been written yet."""
    allowed = left() if LEFT.exists() else counts
    kept = {file: min(number, counts.get(file, 0)) for file, number in allowed.items()}
    lines = [f'"{file}" = {number}' for file, number in sorted(kept.items()) if number]
    head = "# Findings of .ci/prose.py in files that are not rewritten yet: numbers only fall, to none."
    LEFT.write_text("\n".join([head, "[left]", *lines, ""]), encoding="utf-8", newline="\n")


def main(*words: str) -> str | None:
    """Return what is wrong, after printing what was asked for."""
    if words and words != ("--lower",):
        named = [Path(word).resolve() for word in words]
        for path in files():
            if any(path.is_relative_to(each) for each in named):
                for one in findings(path):
                    print(f"{relative(path)}:{one.line}: {one.rule}: ... {one.words} ... [{one.advice}]")
        return None
    counts = dict(Counter({relative(path): len(findings(path)) for path in files()}))
    if words:
        lower(counts)
    wrong = compared(counts, left()) + stale()
    more = [f"... and {len(wrong) - MOST} more files"] if len(wrong) > MOST else []
    return "\n".join(wrong[:MOST] + more) or None


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
