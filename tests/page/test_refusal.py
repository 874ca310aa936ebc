"""What the user can mend is refused with a reason; what we did wrong is said to be ours."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.page.refusal import on_the_page, refusal
from roughcontact.recipe.written import from_plain


def caught(call):
    with pytest.raises(Exception) as error:
        call()
    return refusal(error.value)


def test_an_error_of_the_library_is_refused_as_a_sentence():
    found = caught(lambda: rc.Grid((8, 8), -1.0))
    assert found["how"] == "refused"
    assert found["message"][0].isupper()
    assert found["message"].endswith(".")


@pytest.mark.parametrize(
    "call",
    [lambda: np.zeros(3).reshape(2), lambda: float("three"), lambda: {}["key"]],
    ids=["shape", "number", "key"],
)
def test_an_error_of_a_foreign_library_is_a_mistake_of_ours(call):
    found = caught(call)
    assert found["how"] == "mistake"
    assert "not in your input" in found["message"]


def test_what_a_file_lacks_is_named_by_the_fields_of_the_page(tmp_path):
    file = tmp_path / "heights.npy"
    np.save(file, np.random.default_rng(1).normal(size=(8, 8)))
    found = caught(lambda: rc.read(file))
    assert found["how"] == "refused"
    assert "size" in found["places"]
    assert "the width of the map" in found["message"]


def test_the_folder_of_the_server_stays_unsaid(tmp_path):
    found = caught(lambda: (tmp_path / "part.x3p").open())
    assert found["how"] == "refused"
    assert "part.x3p" in found["message"]
    assert str(tmp_path) not in str(found)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (
            "mask it (masked, surface prepare --mask) or crop it (cropped, --crop)",
            "mask it (Mask) or crop it (Crop)",
        ),
        ("remove faulty points by despiked()", "remove faulty points by Despike"),
        ("use despiked() and --despike", "use Despike"),
        ("read another --channel", "read another Channel"),
        ("pass unit= with the right unit", "fill in Unit with the right unit"),
        ("short_cutoff 2 m is not below long_cutoff 1 m", "Short cutoff 2 m is not below Long cutoff 1 m"),
        ("give `hardness`, or `young2`", "give Hardness, or Young 2"),
        (
            "Give hardness='gold', or unload the joint by loading_loop.",
            "Give Hardness 'gold', or unload the joint by a loop of loads.",
        ),
        (
            "write above=3um; see my_file.x3p, read() or --download",
            "write above=3um; see my_file.x3p, read() or --download",
        ),
    ],
)
def test_messages_name_the_fields_of_the_page(words, expected):
    assert on_the_page(words) == expected


def test_each_value_that_is_wrong_has_a_fault_of_its_own():
    source = {"kind": "self-affine", "hurst": "some", "rms": "1kg", "size": "1mm"}
    found = caught(lambda: from_plain({"job": "surface", "source": source}))
    assert [fault["places"] for fault in found["faults"]] == [["source.hurst"], ["source.rms"]]
    assert found["message"] == " ".join(fault["message"] for fault in found["faults"])
    assert "source." not in found["message"]
