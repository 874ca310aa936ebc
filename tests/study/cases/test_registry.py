from importlib import resources

import pytest

from roughcontact.study.cases import CASES, find_case


@pytest.mark.parametrize("name", CASES)
def test_a_case_of_the_package_is_found_by_its_name(name):
    case = find_case(name)
    assert case.name == name
    assert find_case(CASES[name]) is case


def test_every_case_of_the_package_has_a_name():
    files = resources.files("roughcontact.study.cases").iterdir()
    found = {file.name.removesuffix("_case.py") for file in files if "\nCASE = " in _text(file)}
    assert found == set(CASES)


def _text(file):
    return file.read_text(encoding="utf-8") if file.is_file() and file.name.endswith(".py") else ""
