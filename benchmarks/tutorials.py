"""The pictures of the tutorials: python benchmarks/tutorials.py. Runs their Python in docs/images, which saves them."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

DOCS = Path(__file__).resolve().parent.parent / "docs"


def main() -> None:
    """Run every block of every tutorial."""
    for page in sorted((DOCS / "tutorials").glob("*.md")):
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            for code in re.findall(
                r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE
            ):
                exec(compile(code, page.name, "exec"), {"__name__": "__main__"})
            for picture in Path(folder).glob("*.png"):
                shutil.copy(picture, DOCS / "images" / picture.name)
            os.chdir(DOCS)


if __name__ == "__main__":
    main()
