"""Names that are imported when they are first asked for."""

import compileall
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import roughcontact as rc
from roughcontact.late import late_names

SCRIPT = """
import sys
import roughcontact as rc

assert rc.__file__.startswith(sys.argv[1]), rc.__file__
for package in (rc, rc.theory, rc.mdr):
    for name in sys.argv[2].split(",") if package is rc else ("hertz",) if package is rc.theory else ("indenter",):
        getattr(package, name)
print(rc.theory.hertz.point(radius=1.0, modulus=1.0, force=1.0).depth)
"""


@pytest.mark.parametrize("package", [rc, rc.theory, rc.mdr, rc.plot])
def test_each_name_is_there_once(package):
    names = list(late_names(package.__spec__))
    assert len(names) == len(set(names))
    assert set(names) <= set(package.__all__) == set(dir(package))
    assert all(getattr(package, name) is getattr(package, name) for name in names)


def test_another_name_is_refused_with_those_that_there_are():
    with pytest.raises(
        AttributeError,
        match=r"module 'roughcontact\.theory' has no attribute 'hurtz'; it has adhesive_asperities",
    ):
        _ = rc.theory.hurtz


def test_without_texts_all_is_imported_at_once(tmp_path):
    """As in bundles of programs, which hold compiled modules alone."""
    target = tmp_path / "roughcontact"
    shutil.copytree(Path(rc.__file__).parent, target, ignore=shutil.ignore_patterns("__pycache__", "cli"))
    assert compileall.compile_dir(target, quiet=1, legacy=True)
    for text in target.rglob("*.py"):
        text.unlink()
    environment = os.environ | {"PYTHONPATH": str(tmp_path), "ROUGHCONTACT_CPU": "off"}
    script = [sys.executable, "-c", SCRIPT, str(tmp_path), ",".join(late_names(rc.__spec__))]
    found = subprocess.run(script, capture_output=True, text=True, env=environment)
    assert found.returncode == 0, found.stderr
    assert float(found.stdout) == pytest.approx((9 / 16) ** (1 / 3), rel=1e-12)
