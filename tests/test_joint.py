"""The page on joints quotes the script that computes one."""

from __future__ import annotations

import importlib.util
from pathlib import Path

ROOT = Path(__file__).parents[1]


def test_the_table_of_the_periodic_joint_is_what_the_script_prints(capsys):
    spec = importlib.util.spec_from_file_location("joint", ROOT / "benchmarks" / "joint.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    curve = script.periodic(script.joint())
    assert curve.resolved.all()
    table = [line for line in capsys.readouterr().out.splitlines() if line.startswith("|")]
    assert len(table) == 2 + len(script.PRESSURES)
    page = (ROOT / "docs" / "concepts" / "joints.md").read_text(encoding="utf-8")
    assert "\n".join(table) in page
