"""Machine code on disk: found again, mended, done without; and the whole package without LLVM."""

import ast
import os
import platform
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest

import roughcontact
from roughcontact.kernels import disk, loader
from roughcontact.kernels.processor import VARIABLE

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

FAMILIES = (
    "block_kernels", "dense_kernels", "fft", "near_kernels", "plane_kernels", "tile_kernels", "vector_kernels"
)  # fmt: skip


def test_code_is_translated_once(kept, translated, works):
    assert works()
    assert works()
    assert works("float32")
    assert works("float32")
    assert [precision for _, precision in translated] == ["float64", "float32"]
    assert len(list(kept.iterdir())) == 2


def test_within_a_process_it_is_not_even_looked_for(kept, monkeypatch, works):
    assert works()
    monkeypatch.setattr(disk, "read", None)
    assert loader.functions("tiny", "float64") is loader.functions("tiny", "float64")


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
    package = "roughcontact.kernels."
    found = {n.module for n in ast.walk(tree) if isinstance(n, ast.ImportFrom)}
    near = {module.removeprefix(package) for module in found if module.startswith(package)}
    return near.union(*map(imports, near))


@pytest.mark.parametrize("family", FAMILIES)
def test_no_text_is_left_out_that_a_family_is_written_with(family):
    assert tuple(loader._families()) == FAMILIES
    assert imports(family) <= set(loader.COMMON)


def test_without_texts_code_is_made_and_not_kept(kept, translated, monkeypatch, works):
    """As in bundles of programs, which hold no source."""

    def missing(name):
        raise FileNotFoundError(name)

    monkeypatch.setattr(loader, "_text", missing)
    assert works()
    assert works()
    assert len(translated) == 2
    assert not kept.exists()


def test_a_function_that_was_never_written_is_an_error():
    kernels = loader._kernels("block_kernels")
    code = loader._translated({"sum_blocks": kernels["sum_blocks"]}, "float64")
    with pytest.raises(RuntimeError, match=r"not all of sum_blocks, .* are in the code"):
        loader._loaded(code, kernels, "float64")


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_all_functions_that_a_module_promises_are_there(family, precision):
    found = loader.functions(family, precision)
    assert found.keys() == loader._kernels(family).keys()
    assert all(callable(function) for function in found.values())


def test_where_llvm_is_installed_it_is_used():
    """A mistake of ours in making code must not pass for a machine on which none can be made."""
    loader.functions.__wrapped__("block_kernels", "float64")


def test_what_llvm_cannot_do_here_numpy_does(monkeypatch):
    def fails(kernels, precision):
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
from roughcontact.kernels import loader
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
        "from roughcontact.kernels import loader\n"
        f"assert rc.__file__.startswith({str(archive)!r}) and loader.is_available()\n"
        f"assert loader._key('tile_kernels', 'float64').hex() == {loader._key('tile_kernels', 'float64').hex()!r}"
    )
    environment = {**os.environ, "PYTHONPATH": str(archive)}
    subprocess.run([sys.executable, "-c", script], check=True, timeout=60, env=environment)


def test_importing_what_presses_loads_no_llvm():
    script = "import sys; from roughcontact import press, half_space; sys.exit('llvmlite' in sys.modules)"
    subprocess.run([sys.executable, "-c", script], check=True, timeout=60)
