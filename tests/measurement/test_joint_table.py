"""The table of the emulator is the fit to the kept ensembles."""

import importlib.util
import json
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

SCRIPT = Path(__file__).resolve().parents[2] / "benchmarks" / "joint_table.py"


@pytest.mark.skipif(not SCRIPT.is_file(), reason="the benchmarks are not here")
def test_it_is_what_the_script_writes(tmp_path, monkeypatch, capsys):
    spec = importlib.util.spec_from_file_location("joint_table", SCRIPT)
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    monkeypatch.setattr(script, "TABLE", tmp_path / "table.json")
    monkeypatch.setattr("sys.argv", ["joint_table.py"])
    script.main()
    shipped = json.loads(files("roughcontact.measurement").joinpath("joint_table.json").read_text())
    written = json.loads((tmp_path / "table.json").read_text())
    assert written.keys() == shipped.keys()
    for name, values in shipped.items():  # six decimals are kept
        np.testing.assert_allclose(written[name], values, rtol=0, atol=2e-6, err_msg=name)
    assert "unseen specimens" in capsys.readouterr().out
