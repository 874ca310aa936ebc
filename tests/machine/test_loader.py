"""Machine code on disk: found again, mended, done without; and the whole package without LLVM."""

import ast
import importlib.util
import os
import platform
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import platformdirs
import pytest

import roughcontact
from roughcontact.machine import disk, loader
from roughcontact.machine.processor import VARIABLE

posix = pytest.mark.skipif(os.name != "posix", reason="owners and modes are those of POSIX")
pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

FAMILIES = ("fourier", "judging", "passes", "scaling", "tiles")
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
    """Return the folder for caches, which is empty, of a package with two small families: one adds, one subtracts."""
    if disk.private(tmp_path) is None:
        pytest.skip("others can write to the folder of the tests")
    source, caches = tmp_path / "source", tmp_path / "caches"
    source.mkdir()
    for name in loader.COMMON:
        (source / f"{name}.py").write_bytes(loader._text(name))
    families = {"tiny": TINY, "other": TINY.replace("+ by", "- by")}
    for name, text in families.items():
        (source / f"{name}.py").write_text(text)
        spec = importlib.util.spec_from_file_location(name, source / f"{name}.py")
        families[name] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(families[name])
    monkeypatch.setattr(loader, "_families", lambda: families)
    monkeypatch.setattr(loader, "_text", lambda name: (source / f"{name}.py").read_bytes())
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


@pytest.fixture
def others(monkeypatch):
    """Return what gives a file or folder to another user; where only root may, this user becomes another."""
    other = os.geteuid() + 54321
    if os.geteuid() == 0:
        return lambda place: os.chown(place, other, -1)
    return lambda place: monkeypatch.setattr(os, "geteuid", lambda: other)


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
    monkeypatch.setattr(disk, "read", None)
    assert loader.functions("tiny", "float64") is loader.functions("tiny", "float64")


@pytest.mark.parametrize(
    "damage",
    [
        lambda whole: b"",
        lambda whole: whole[:10],
        lambda whole: whole[: disk.DIGEST],
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
    assert works()
    (place,) = kept.iterdir()
    place.unlink()
    place.mkdir()
    (place / "something").write_text("in the way")
    assert works()
    assert [f.name for f in kept.iterdir()] == [place.name]
    assert works()
    assert len(translated) == 3


def test_a_disk_that_is_full_does_not_matter(kept, translated, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
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
def test_code_depends_on_the_text_that_wrote_it(kept, name):
    before = loader._key("tiny", "float64")
    assert loader._key("tiny", "float64") == before
    file = kept.parent.parent / "source" / f"{name}.py"
    file.write_bytes(file.read_bytes() + b"\n# more\n")
    assert loader._key("tiny", "float64") != before


def test_code_depends_on_the_version_of_llvm_and_on_the_processor(kept, monkeypatch):
    import llvmlite

    before = loader._key("tiny", "float64")
    keys = {before, loader._key("tiny", "float32"), loader._key("other", "float64")}
    name, features = loader.processor()
    for where, attribute, value in (
        (llvmlite, "__version__", "0.0.0"),
        (llvmlite.binding, "llvm_version_info", (0, 0, 0)),
        (loader, "processor", lambda: ("abacus", features)),
        (loader, "processor", lambda: (name, features + ",+beads")),
    ):
        with monkeypatch.context() as other:
            other.setattr(where, attribute, value)
            keys.add(loader._key("tiny", "float64"))
    assert len(keys) == 7
    assert loader._key("tiny", "float64") == before


def imports(name):
    """Return the modules of this package that one of its modules imports, and those that they import."""
    tree = ast.parse(loader._text(name))
    package = "roughcontact.machine."
    found = {n.module for n in ast.walk(tree) if isinstance(n, ast.ImportFrom)}
    near = {module.removeprefix(package) for module in found if module.startswith(package)}
    return near.union(*map(imports, near))


@pytest.mark.parametrize("family", FAMILIES)
def test_no_text_is_left_out_that_a_family_is_written_with(family):
    assert tuple(loader._families()) == FAMILIES
    assert imports(family) <= set(loader.COMMON)


def test_without_texts_code_is_made_and_not_kept(kept, translated, monkeypatch):
    """As in bundles of programs, which hold no source."""

    def missing(name):
        raise FileNotFoundError(name)

    monkeypatch.setattr(loader, "_text", missing)
    assert works()
    assert works()
    assert len(translated) == 2
    assert not kept.exists()


def test_code_of_another_key_is_not_run(kept, translated):
    """It subtracts, or takes numbers of another precision; its name says otherwise."""
    for family, precision in (("other", "float64"), ("tiny", "float32")):
        assert works()
        (ours,) = kept.glob("tiny-float64-*")
        loader.functions(family, precision)
        (theirs,) = kept.glob(f"{family}-{precision}-*")
        os.replace(theirs, ours)
        assert works()
    assert [done for done in translated if done == ("tiny", "float64")] == [("tiny", "float64")] * 3


def test_code_without_the_function_is_made_anew(kept, translated):
    """An address of 0, which would end the process."""
    assert works()
    (file,) = kept.iterdir()
    wrong = loader._translated(loader._families()["tiny"], "float32")
    disk.keep(file.name, loader._key("tiny", "float64"), wrong)
    assert works()
    assert works()
    assert [precision for _, precision in translated] == ["float64", "float32", "float64"]


def test_a_function_that_was_never_written_is_an_error():
    code = loader._translated(loader._families()["scaling"], "float64")
    with pytest.raises(RuntimeError, match="widen, nothing are in the code"):
        loader._loaded(code, {"widen": "", "nothing": ""}, "float64")


@posix
@pytest.mark.parametrize("mode", [0o660, 0o606, 0o666])
def test_a_file_that_others_can_write_to_is_not_run_but_replaced(kept, translated, mode):
    assert works()
    (file,) = kept.iterdir()
    file.chmod(mode)
    assert works()
    assert works()
    assert len(translated) == 2
    assert file.stat().st_mode & 0o77 == 0


@posix
def test_a_file_of_another_user_is_not_run(kept, translated, others):
    assert works()
    others(next(kept.iterdir()))
    assert works()
    assert len(translated) == 2


@posix
@pytest.mark.parametrize("mode", [0o770, 0o707, 0o1777])
@pytest.mark.parametrize("above", [False, True])
def test_a_folder_that_others_can_write_to_is_neither_read_nor_written(kept, translated, mode, above):
    assert works()
    (kept.parent if above else kept).chmod(mode)
    assert works()
    if above and mode & 0o1000:  # as /tmp is: everybody writes, but what is in it belongs to its owners
        assert len(translated) == 1
    else:
        assert works("float32")
        assert len(translated) == 3
        assert len(list(kept.iterdir())) == 1


@posix
@pytest.mark.parametrize("above", [False, True])
def test_a_folder_of_another_user_is_neither_read_nor_written(kept, translated, others, above):
    assert works()
    others(kept.parent if above else kept)
    assert works()
    assert works("float32")
    assert len(translated) == 3
    assert len(list(kept.iterdir())) == 1


@posix
def test_a_link_in_place_of_a_file_is_not_followed_but_replaced(kept, translated, tmp_path):
    assert works()
    (file,) = kept.iterdir()
    file.rename(tmp_path / "elsewhere")
    file.symlink_to(tmp_path / "elsewhere")
    assert works()
    assert works()
    assert len(translated) == 2
    assert not file.is_symlink()


@posix
def test_a_pipe_in_place_of_a_file_keeps_nobody_waiting(kept, translated):
    assert works()
    (file,) = kept.iterdir()
    file.unlink()
    os.mkfifo(file)
    assert works()
    assert works()
    assert len(translated) == 2


@posix
@pytest.mark.parametrize("open_to_others", [False, True])
def test_a_link_to_a_folder_is_as_good_as_the_folder(kept, translated, tmp_path, open_to_others):
    """A folder for caches on another disk, say."""
    (tmp_path / "disk").mkdir(mode=0o700)
    kept.parent.symlink_to(tmp_path / "disk")
    if open_to_others:
        (tmp_path / "disk").chmod(0o777)
    assert works()
    assert works()
    assert len(translated) == 1 + open_to_others


@posix
def test_folders_are_made_for_the_user_alone(kept, translated):
    before = os.umask(0o002)
    try:
        assert works()
    finally:
        os.umask(before)
    assert [place.stat().st_mode & 0o777 for place in (kept, kept.parent)] == [0o700, 0o700]
    assert works()
    assert len(translated) == 1


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_all_functions_that_a_module_promises_are_there(family, precision):
    writer = loader._families()[family]
    found = loader.functions(family, precision)
    assert found.keys() == writer.KINDS.keys()
    assert all(callable(function) for function in found.values())


def test_where_llvm_is_installed_it_is_used():
    """A mistake of ours in making code must not pass for a machine on which none can be made."""
    loader.functions.__wrapped__("scaling", "float64")


def test_what_llvm_cannot_do_here_numpy_does(monkeypatch):
    def fails(writer, precision):
        raise RuntimeError("no such instruction")

    monkeypatch.setattr(loader, "_translated", fails)
    monkeypatch.setattr(disk, "read", lambda name, key: None)
    loader.functions.cache_clear()
    assert not loader.is_available.__wrapped__()
    loader.functions.cache_clear()


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
# A processor that every machine of this kind can stand in for.
NAMES = {"x86_64": "x86-64", "amd64": "x86-64", "aarch64": "generic", "arm64": "generic"}
COMMON_NAME = NAMES.get(platform.machine().lower(), "native")


def answers(folder, without=False, **environment):
    file = str(folder / "answers.npz")
    script = ANSWERS.format(without=without, file=file)
    command = [sys.executable, "-W", "error", "-c", script]
    subprocess.run(command, check=True, timeout=300, env={**os.environ, **environment})
    with np.load(file) as found:
        return dict(found)


@pytest.fixture(scope="module")
def here(tmp_path_factory):
    return answers(tmp_path_factory.mktemp("here"))


@pytest.mark.parametrize("way", [{"without": True}, {VARIABLE: COMMON_NAME}], ids=["no LLVM", COMMON_NAME])
def test_without_llvm_or_for_another_processor_answers_are_the_same(tmp_path, here, way):
    """Each is certified to 1e-8 of the largest displacement."""
    there = answers(tmp_path, **way)
    for name in ("free", "periodic"):
        largest = here[name].max()
        assert (here[name] > 0).mean() > 0.4
        np.testing.assert_allclose(there[name], here[name], rtol=0, atol=1e-6 * largest)
        depth, stiffness, area = here[f"{name} curve"]
        other_depth, other_stiffness, other_area = there[f"{name} curve"]
        np.testing.assert_allclose(other_depth, depth, rtol=1e-7)
        np.testing.assert_allclose(other_stiffness, stiffness, rtol=1e-7)
        np.testing.assert_array_equal(other_area, area)


def test_from_a_zip_archive_the_package_runs_and_knows_its_texts(tmp_path):
    source, archive = Path(roughcontact.__file__).parent, tmp_path / "package.zip"
    with zipfile.ZipFile(archive, "w") as packed:
        for file in source.rglob("*.py"):
            packed.write(file, file.relative_to(source.parent))
    script = (
        "import roughcontact as rc\n"
        "from roughcontact.machine import loader\n"
        f"assert rc.__file__.startswith({str(archive)!r}) and loader.is_available()\n"
        f"assert loader._key('tiles', 'float64').hex() == {loader._key('tiles', 'float64').hex()!r}"
    )
    environment = {**os.environ, "PYTHONPATH": str(archive)}
    subprocess.run([sys.executable, "-c", script], check=True, timeout=60, env=environment)


def test_importing_what_presses_loads_no_llvm():
    script = "import sys; from roughcontact import press, half_space; sys.exit('llvmlite' in sys.modules)"
    subprocess.run([sys.executable, "-c", script], check=True, timeout=60)
