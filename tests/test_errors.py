"""The page on errors quotes the script that measures them."""

from __future__ import annotations

import importlib
from pathlib import Path

ROOT = Path(__file__).parents[1]


def test_the_table_of_bandwidth_is_what_the_script_prints(capsys, monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "benchmarks")  # it takes the joint of the script beside it
    importlib.import_module("errors").bandwidth()
    table = [line for line in capsys.readouterr().out.splitlines() if line.startswith("|")]
    assert len(table) == 2 + 5
    page = (ROOT / "docs" / "errors.md").read_text(encoding="utf-8")
    assert "\n".join(table) in page
