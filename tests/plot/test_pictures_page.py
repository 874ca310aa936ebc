"""The page on pictures says what runs, and names what there is."""

import re
from pathlib import Path

import pytest
from matplotlib import pyplot

import roughcontact as rc

PAGE = (Path(__file__).parents[2] / "docs" / "pictures.md").read_text(encoding="utf-8")


def test_its_code_runs_as_printed(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names: dict = {}
    try:
        for code in re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL):
            exec(code, names)
        assert len(pyplot.get_fignums()) == 4, "surface, solution and curve twice; none of what is given axes"
    finally:
        pyplot.close("all")
    assert (tmp_path / "sample.pdf").read_bytes().startswith(b"%PDF")
    assert names["figure"].axes[1].get_title() == "my sample"
    assert names["frame"].attrs["units"]["stiffness"] == "N m-1"


@pytest.mark.parametrize("name", rc.plot.__all__)
def test_every_function_stands_on_it(name):
    assert re.search(rf"\b{name}\b", PAGE)
