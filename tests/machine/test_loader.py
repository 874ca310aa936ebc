"""Machine code on disk: found again, mended, done without; and the whole package without LLVM."""

import importlib.metadata
import importlib.util
import subprocess
import sys
from pathlib import Path

import numpy as np
import platformdirs
import pytest

from roughcontact.machine import loader

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

TINY = '''
"""Adds a number to some."""

from roughcontact.machine.code import Code

KINDS = {"add": "index reals real"}


def write(module, precision):
    with Code(module, "add", precision, KINDS["add"]) as code:
        n, x, by = code.arguments
        for at in code.range(0, n):
            x.put(at, x.take_one(at) + by)
'''


@pytest.fixture
def kept(monkeypatch, tmp_path):
    """Return the folder for caches, which is empty, of a package whose only machine code is tiny."""
    source, caches = tmp_path / "source", tmp_path / "caches"
    source.mkdir()
    for name in loader.COMMON:
        (source / f"{name}.py").write_bytes((Path(loader.__file__).parent / f"{name}.py").read_bytes())
    (source / "tiny.py").write_text(TINY)
    spec = importlib.util.spec_from_file_location("roughcontact.machine.tiny", source / "tiny.py")
    tiny = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tiny)
    monkeypatch.setitem(sys.modules, "roughcontact.machine.tiny", tiny)
    monkeypatch.setattr(loader, "__file__", str(source / "loader.py"))
    monkeypatch.setattr(platformdirs, "user_cache_path", lambda name: caches / name)
    loader.functions.cache_clear()
    yield caches / "roughcontact"
    loader.functions.cache_clear()


@pytest.fixture
def translated(monkeypatch):
    """Return a list that grows with each translation."""
    done, translate = [], loader._translated

    def counted(writer, precision):
        done.append((writer.__name__, precision))
        return translate(writer, precision)

    monkeypatch.setattr(loader, "_translated", counted)
    return done


def works(precision="float64"):
    """Whether a new process would have the function: this one forgets it first."""
    loader.functions.cache_clear()
    numbers = np.arange(5, dtype=precision)
    loader.functions("tiny", precision)["add"](5, loader.address(numbers), 0.5)
    return numbers.tolist() == [0.5, 1.5, 2.5, 3.5, 4.5]


def test_code_is_translated_once(kept, translated):
    assert works()
    assert works()
    assert works("float32")
    assert works("float32")
    assert [precision for _, precision in translated] == ["float64", "float32"]
    assert len(list(kept.iterdir())) == 2


def test_within_a_process_it_is_not_even_looked_for(kept, monkeypatch):
    assert works()
    monkeypatch.setattr(loader, "_read", None)
    assert loader.functions("tiny", "float64") is loader.functions("tiny", "float64")


@pytest.mark.parametrize(
    "damage",
    [
        lambda whole: b"",
        lambda whole: whole[:10],
        lambda whole: whole[: loader.DIGEST],
        lambda whole: whole[:-1],
        lambda whole: whole[: len(whole) // 2],
        lambda whole: whole + b"\0",
        lambda whole: bytes([whole[0] ^ 1]) + whole[1:],
        lambda whole: whole[:-200] + bytes([whole[-200] ^ 64]) + whole[-199:],
        lambda whole: bytes(len(whole)),
    ],
)
def test_damaged_code_is_translated_anew_and_replaced(kept, translated, damage):
    assert works()
    (file,) = kept.iterdir()
    whole = file.read_bytes()
    file.write_bytes(damage(whole))
    assert works()
    assert len(translated) == 2
    assert [f.name for f in kept.iterdir()] == [file.name]
    assert works()
    assert len(translated) == 2


def test_nothing_half_written_stays(kept, translated):
    """A file in the code's place that cannot be replaced: the rest of it is taken away."""
    place = loader._place("tiny", "float64")
    place.mkdir(parents=True)
    (place / "something").write_text("in the way")
    assert works()
    assert [f.name for f in kept.iterdir()] == [place.name]
    assert works()
    assert len(translated) == 2


def test_a_disk_that_is_full_does_not_matter(kept, translated, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(loader.os, "replace", full)
    assert works()
    assert list(kept.iterdir()) == []


def test_a_folder_that_cannot_be_made_does_not_matter(kept, translated, monkeypatch, tmp_path):
    (tmp_path / "file").write_text("not a folder")
    monkeypatch.setattr(platformdirs, "user_cache_path", lambda name: tmp_path / "file" / name)
    assert works()
    assert works()
    assert len(translated) == 2
    assert (tmp_path / "file").read_text() == "not a folder"


@pytest.mark.parametrize("name", [*loader.COMMON, "tiny"])
def test_code_hangs_on_the_text_that_wrote_it(kept, name):
    before = loader._place("tiny", "float64")
    assert loader._place("tiny", "float64") == before
    file = Path(loader.__file__).parent / f"{name}.py"
    file.write_bytes(file.read_bytes() + b"\n# more\n")
    assert loader._place("tiny", "float64") != before


def test_code_hangs_on_the_version_of_llvm_and_on_the_processor(kept, monkeypatch):
    from llvmlite import binding

    before = loader._place("tiny", "float64")
    places = {before, loader._place("tiny", "float32")}
    with monkeypatch.context() as other:
        other.setattr(importlib.metadata, "version", lambda name: "0.0.0")
        places.add(loader._place("tiny", "float64"))
    with monkeypatch.context() as other:
        other.setattr(binding, "get_host_cpu_name", lambda: "abacus")
        places.add(loader._place("tiny", "float64"))
    assert len(places) == 4
    assert loader._place("tiny", "float64") == before


@pytest.mark.parametrize("family", ["fourier", "passes"])
@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_all_functions_that_a_module_promises_are_there(family, precision):
    writer = importlib.import_module(f"roughcontact.machine.{family}")
    found = loader.functions(family, precision)
    assert found.keys() == writer.KINDS.keys()
    assert all(callable(function) for function in found.values())


ANSWERS = """
import sys
if {without}:
    sys.modules["llvmlite"] = None
import numpy as np
import roughcontact as rc
assert {without} or "llvmlite" not in sys.modules
from roughcontact.machine import loader
assert loader.is_available() is not {without}
answers = dict()
for periodic in (False, True):
    grid = rc.Grid((64, 64), 1 / 64, periodic)
    rough = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(0))
    one = rc.press(rough, 1.0, force=0.05)
    curve = rc.loading_curve(rough, 1.0, forces=np.geomspace(1e-3, 0.06, 5))
    name = "periodic" if periodic else "free"
    answers[name] = one.pressure
    answers[name + " curve"] = [curve.depth, curve.stiffness, curve.contact_area]
np.savez({file!r}, **answers)
"""


def answers(without, folder):
    file = str(folder / f"{without}.npz")
    script = ANSWERS.format(without=without, file=file)
    subprocess.run([sys.executable, "-W", "error", "-c", script], check=True, timeout=300)
    with np.load(file) as found:
        return dict(found)


def test_without_llvm_answers_are_the_same(tmp_path):
    """Each is certified to 1e-8 of the largest displacement."""
    here, there = (answers(without, tmp_path) for without in (False, True))
    for name in ("free", "periodic"):
        largest = here[name].max()
        assert (here[name] > 0).mean() > 0.4
        np.testing.assert_allclose(there[name], here[name], rtol=0, atol=1e-6 * largest)
        depth, stiffness, area = here[f"{name} curve"]
        other_depth, other_stiffness, other_area = there[f"{name} curve"]
        np.testing.assert_allclose(other_depth, depth, rtol=1e-7)
        np.testing.assert_allclose(other_stiffness, stiffness, rtol=1e-7)
        np.testing.assert_array_equal(other_area, area)


def test_importing_what_presses_loads_no_llvm():
    script = "import sys; from roughcontact import press, half_space; sys.exit('llvmlite' in sys.modules)"
    subprocess.run([sys.executable, "-c", script], check=True, timeout=60)
