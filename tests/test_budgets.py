"""The house stays small: each number is raised only with a reason in the commit.

`python tests/house_sizes.py` prints what they are.
"""

import pytest

import house_sizes
from roughcontact.kernels import loader

CODE = 62_450  # lines of code under src, without docstrings and comments
PARAMETERS = {
    "roughcontact.self_affine": 13,
    "roughcontact.loading_curve": 11,  # numbers beside those of a curve
    "roughcontact.viscoelastic_path": 11,  # times beside the loads, and their steps
    "roughcontact.viscoelastic_curve": 13,
}
# Commands that press take every step of a preparation, and the help shows the everyday options first. Each command has
# --quiet, --verbose and --help-all.
OPTIONS = {
    "curve": 68,  # two of noise, two of flow, two of ultrasound, four of gas, radiation and film, one of friction
    "leak": 55,
    "joint": 55,
    "infer": 37,  # three ways to measure, a topography, bodies, two units
    "shear": 46,
    "creep": 38,
    "press": 51,
    "adhesion press": 46,
    "adhesion curve": 46,
    "adhesion detach": 45,
    "adhesion loop": 44,
    "sliding": 37,
    "theory": 30,
    "surface prepare": 28,
    "surface specified": 20,
    "surface spectrum": 19,
    "surface make": 17,
}
FILES = {"files": 60}  # one a format, and what a computation keeps: their names are the table of contents
# Changes of file and calls, with machine code; a tenth more for other processors, where other kernels are called.
WAYS = {"a press": (7.1, 15.9), "a curve of six loads": (2.62, 4.43)}  # per call of machine code


def beyond(found, allowed, most):
    return {name: count for name, count in found.items() if count > allowed.get(name, most)}


def test_lines_of_code():
    assert house_sizes.sizes(house_sizes.SOURCE)[2] <= CODE


def test_parameters_of_public_functions():
    assert beyond(house_sizes.widths(), PARAMETERS, 10) == {}


def test_options_of_commands():
    assert beyond(house_sizes.options(), OPTIONS, 14) == {}


def test_files_in_a_folder():
    assert beyond(house_sizes.files_in_folders(), FILES, 25) == {}


def test_no_file_imports_itself_by_way_of_others():
    """Neither at once, nor in a function when it is called; for type checkers through `methods` alone."""
    assert house_sizes.circles(house_sizes.import_graph()) == []
    every = house_sizes.import_graph().keys()
    assert house_sizes.circles(house_sizes.import_graph(typed=every - {"roughcontact.methods"})) == []
    assert (
        len(house_sizes.circles(house_sizes.import_graph(typed=every))[0]) > 50
    )  # what is looked for is seen


@pytest.mark.skipif(not loader.is_available(), reason="without machine code other files are passed")
def test_the_way_of_a_load():
    for name, found in house_sizes.ways(256).items():
        assert all(a <= 1.1 * b for a, b in zip(found, WAYS[name], strict=True)), (name, found)


def test_what_counts_is_counted():
    text = '"""A module."""\n\nx = """two\nlines"""  # of code\n\n\ndef f():\n    """Nothing."""\n'
    assert house_sizes.code_lines(text) == 3
    graph = {"a": {"b"}, "b": {"c"}, "c": {"b"}, "d": {"a"}}
    assert house_sizes.circles(graph) == [{"b", "c"}]
    assert beyond({"a": 3, "b": 3}, {"a": 4}, 2) == {"b": 3}
