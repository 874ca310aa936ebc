"""Which errors speak to the user."""

import pytest

from roughcontact.files.own_errors import is_ours

RAISES = "def refuse():\n    raise ValueError('no')"


@pytest.mark.parametrize(
    ("module", "ours"),
    [
        ("roughcontact.grid", True),
        ("roughcontact_thesis.figures", True),
        ("roughcontacts", False),
        ("numpy", False),
    ],
)
def test_errors_are_ours_by_the_package_that_raises_them(module, ours):
    names = {"__name__": module}
    exec(RAISES, names)
    with pytest.raises(ValueError, match="no") as caught:
        names["refuse"]()
    assert is_ours(caught.value) is ours


def test_an_error_of_a_call_is_a_mistake_of_the_caller():
    names = {"__name__": "roughcontact_thesis.figures"}
    exec("def refuse():\n    return int('x')", names)
    with pytest.raises(ValueError, match="invalid literal") as caught:
        names["refuse"]()
    assert not is_ours(caught.value)
