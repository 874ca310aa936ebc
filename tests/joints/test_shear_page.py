"""The page on shear quotes the script that computes its tables."""

import importlib.util
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("part", ["accuracy", "amplitudes", "reduced"])
def test_the_tables_are_what_the_script_prints(part, capsys):
    spec = importlib.util.spec_from_file_location("script", ROOT / "benchmarks" / "joints_under_shear.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    getattr(script, part)()
    table = [line for line in capsys.readouterr().out.splitlines() if line.startswith("|")]
    assert len(table) > 4
    page = (ROOT / "docs" / "concepts" / "joints-shear.md").read_text(encoding="utf-8")
    assert "\n".join(table) in page
