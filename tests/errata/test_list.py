"""docs/evidence/errata.md and the tests speak of the same equations."""

import re
from pathlib import Path

HERE = Path(__file__).parent
PAGE = (HERE.parent.parent / "docs" / "evidence" / "errata.md").read_text(encoding="utf-8")


def test_every_row_names_a_test_that_exists():
    rows = [line for line in PAGE.splitlines() if line.startswith("| ")][1:]
    named = [re.search(r"`(test_\w+)` \|$", row)[1] for row in rows]
    texts = [path.read_text(encoding="utf-8") for path in HERE.glob("test_*.py")]
    written = {name for text in texts for name in re.findall(r"^ *def (test_\w+)", text, re.MULTILINE)}
    assert len(set(named)) == len(named) >= 20
    assert set(named) <= written
