"""The house keeps its shape: imports point one way, and disk and screen stay at the rim."""

import ast
import importlib
import subprocess
import sys
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

import house_sizes
import roughcontact
from roughcontact import methods
from roughcontact.late import LateMethod

SOURCE = Path(roughcontact.__file__).parent
FILES = sorted(SOURCE.rglob("*.py"))
THESIS = sorted((Path(__file__).parents[1] / "reproduction" / "src").rglob("*.py"))  # its figures
# Each room may look into those before it, and into itself.
ORDER = [
    {"errors"},
    {"cached", "memory", "progress", "threads", "units", "version"},
    {"validation"},
    {"guesses"},
    {"late"},
    {"kernels"},
    {"arrays"},
    {"slabs"},
    {"transforms"},
    {"grid", "material"},
    {"materials"},
    {"surface"},
    {"halfspace"},
    {"labels"},
    {"solver"},
    {"statistics"},
    {"contact"},
    {"gradients"},
    {"evaluation"},
    {"measurement"},
    {"adhesion"},
    {"fluid"},
    {"friction"},
    {"joints"},
    {"viscoelastic"},
    {"mdr"},
    {"testing"},
    {"files"},
    {"recipe"},
    {"citing"},
    {"study"},
    {"plot"},
    {"page"},
    {"cli"},
]
RANK = {room: rank for rank, rooms in enumerate(ORDER) for room in rooms}
# `theory` stands beside the house; `methods` and the three top files open doors and do nothing else.
DOORS = {"methods", "__init__", "__main__", "quiet_start"}
BESIDE = {"theory", *DOORS}
METHODS = "roughcontact.methods"
AT_THE_RIM = RANK["files"]
KEEPS_CODE = SOURCE / "kernels" / "disk.py"  # what is translated once is kept on disk
ASKS_LINUX = SOURCE / "memory.py"  # which tells the limit of a container in files
DISK_AND_SCREEN = {
    *("h5netcdf", "h5py", "io", "logging", "matplotlib", "netCDF4", "pathlib", "pickle", "rich", "shutil"),
    *("sqlite3", "tempfile", "typer"),
}
HEAVY = {
    *("SurfaceTopography", "h5netcdf", "h5py", "jax", "llvmlite", "matplotlib", "pandas", "pint", "rich"),
    *("torch", "typer", "xarray"),
}
WRITES = {"open", "print", "save", "savetxt", "savez", "tofile", "to_netcdf", "write_bytes", "write_text"}


def module_of(path):
    parts = path.relative_to(SOURCE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def room_of(path):
    return path.relative_to(SOURCE).parts[0].removesuffix(".py")


@cache
def imported(tree):
    """Return the names of all modules that `tree` imports, those inside functions too."""
    names = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports are written in full"
            # The thing imported may be a module itself.
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return names


def wrong_way(room, names):
    """Return the rooms among the imported `names` that `room` must not look into."""
    rooms = {name.split(".")[1] for name in names if name.startswith("roughcontact.")} & RANK.keys()
    return {other for other in rooms if other != room and RANK[other] >= RANK[room]}


def foreign(names):
    return {name.split(".")[0] for name in names} - {"roughcontact"} - set(sys.stdlib_module_names)


def called(tree):
    """Return the last names of all that `tree` calls."""
    functions = [node.func for node in ast.walk(tree) if isinstance(node, ast.Call)]
    return {
        f.id if isinstance(f, ast.Name) else f.attr
        for f in functions
        if isinstance(f, ast.Name | ast.Attribute)
    }


def trees():
    return {path: house_sizes.tree(path) for path in FILES}


def modules():
    return {module_of(path): tree for path, tree in trees().items()}


def test_every_file_belongs_to_a_room_that_the_design_knows():
    assert {room_of(path) for path in FILES} <= RANK.keys() | BESIDE


def test_no_file_is_longer_than_400_lines():
    lengths = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in [*FILES, *THESIS]}
    assert {path: length for path, length in lengths.items() if length > 400} == {}


def test_imports_point_one_way():
    wrong = {
        path: wrong_way(room_of(path), imported(tree))
        for path, tree in trees().items()
        if room_of(path) in RANK
    }
    assert {path: rooms for path, rooms in wrong.items() if rooms} == {}


def test_nothing_needs_the_package_of_the_figures():
    names = set().union(*(imported(tree) for tree in trees().values()))
    assert not any(name.startswith("roughcontact_thesis") for name in names)


def test_the_figures_are_there_without_a_circle():
    parsed = {f"roughcontact_thesis.{path.stem}": house_sizes.tree(path) for path in THESIS}
    assert len(parsed) > 50
    assert house_sizes.circles(house_sizes.import_graph(THESIS[0].parent)) == []
    assert [name for name, tree in parsed.items() if "print" in called(tree)] == []


def test_theory_needs_arrays_alone():
    names = set().union(*(imported(tree) for path, tree in trees().items() if room_of(path) == "theory"))
    assert foreign(names) <= {"numpy", "scipy"}
    below = tuple(f"roughcontact.{room}" for room in ("errors", "late", "theory", "validation"))
    assert all(name.startswith(below) for name in names if "roughcontact" in name)


def test_disk_and_screen_stay_at_the_rim():
    within = {
        path: tree
        for path, tree in trees().items()
        if RANK.get(room_of(path), 0) < AT_THE_RIM
        and room_of(path) not in DOORS
        and path not in {KEEPS_CODE, ASKS_LINUX}
    }
    asked = {
        path: {name.split(".")[0] for name in imported(tree)} & DISK_AND_SCREEN
        for path, tree in within.items()
    }
    written = {path: called(tree) & WRITES for path, tree in within.items()}
    assert {path: asked[path] | written[path] for path in within if asked[path] | written[path]} == {}
    assert [path for path, tree in trees().items() if "print" in called(tree)] == []


def test_a_fork_catches_every_property_that_is_kept():
    assert [path for path, tree in trees().items() if "functools.cached_property" in imported(tree)] == []


def test_methods_names_each_function_once_for_types_and_once_at_run_time():
    block = next(node for node in modules()[METHODS].body if isinstance(node, ast.If))
    typed = {
        (node.module, alias.name) for node in block.body for alias in node.names if alias.asname == alias.name
    }
    late = {name: each for name, each in vars(methods).items() if isinstance(each, LateMethod)}
    assert typed == {(each.module, each.name) for each in late.values()}
    assert all(name == each.name for name, each in late.items())
    assert len(typed) == sum(len(node.names) for node in block.body)


def test_bundlers_of_programs_find_what_is_opened_late():
    """They follow imports that are written out from where a program enters, those for the type checker too."""
    names = {module: imported(tree) for module, tree in modules().items()}
    found, left = set(), {"roughcontact", "roughcontact.cli.main"}
    while left:
        found |= left
        wanted = {name for module in left for name in names[module]}
        packages = {name.rpartition(".")[0] for name in wanted}
        left = (wanted | packages) & names.keys() - found
    of_tests = {name for name in names if name.startswith("roughcontact.testing")}  # no program imports it
    assert names.keys() - found == {"roughcontact.__main__", *of_tests}


def test_the_checks_see_what_they_look_for():
    tree = ast.parse(
        "import matplotlib.pyplot as plt\nfrom roughcontact.contact import press\nopen('x'); a.save(1)"
    )
    assert wrong_way("surface", imported(tree)) == {"contact"}
    assert wrong_way("plot", imported(tree)) == set()
    assert wrong_way("grid", imported(ast.parse("import roughcontact.material"))) == {"material"}
    assert foreign(imported(tree)) == {"matplotlib"}
    assert called(tree) == {"open", "save"}


def loaded(script, *arguments):
    """Return the top modules, and those of SciPy, that a script has loaded when it ends."""
    ending = "import atexit, sys; atexit.register(lambda: sys.stderr.write('\\n' + ' '.join(sys.modules)))\n"
    words = [sys.executable, "-c", ending + script, *map(str, arguments)]
    answer = subprocess.run(words, capture_output=True, encoding="utf-8", check=True)
    names = {tuple(name.split(".")) for name in answer.stderr.splitlines()[-1].split()}
    return {".".join(name[: 2 if name[0] == "scipy" else 1]) for name in names}


def test_importing_the_package_and_all_its_names_loads_no_heavy_library():
    first = "import roughcontact\n"
    assert loaded(first) & {"numpy", "scipy"} == set()
    assert loaded(f"{first}for name in roughcontact.__all__: getattr(roughcontact, name)") & HEAVY == set()


def test_a_load_loads_only_what_it_computes_with(tmp_path):
    """From Python, and from the shell, where typer may take pydantic to look at options."""
    script = """
import roughcontact as rc
ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
rc.press(ball, 1e9, force=1e-3)
rc.differentiable_curve(ball.grid, 1e9, forces=[1e-3])(ball.heights)
"""
    idle = ("integrate", "interpolate", "optimize", "sparse", "spatial")
    unasked = HEAVY - {"llvmlite"} | {f"scipy.{name}" for name in idle}
    assert loaded(script) & {*unasked, "pydantic", "scipy.ndimage"} == set()
    command = "from roughcontact.cli.main import run; run()"
    path = tmp_path / "part.npz"
    loaded(
        command, "surface", "make", path, "--hurst", "0.8", "--rms", "0.1um", "--size", "1mm", "--points", 32
    )
    found = loaded(command, "press", path, "--force", "1N", "--modulus", "110GPa")
    assert found & (unasked - {"typer"}) == set()
    assert "scipy.ndimage" in found  # spots: the check sees what it looks for


@pytest.mark.parametrize(
    "words", [("press",), ("adhesion", "loop"), ("surface", "prepare"), ("study", "plot")]
)
def test_help_of_a_command_waits_for_no_numerics(words):
    found = loaded("from roughcontact.cli.main import run; run()", *words, "--help")
    assert "typer" in found
    assert found & (HEAVY - {"rich", "typer"} | {"numpy", "scipy"}) == set()


def test_what_another_file_imports_stands_in_all():
    public = {
        module: {
            node.name
            for node in tree.body
            if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name[0] != "_"
        }
        for module, tree in modules().items()
    }
    taken = {
        (node.module, alias.name)
        for tree in modules().values()
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
        if alias.name in public.get(node.module, ())
    }
    stated = {module: getattr(importlib.import_module(module), "__all__", None) for module, _ in taken}
    missing = {(module, name) for module, name in taken if stated[module] and name not in stated[module]}
    assert missing == set()
    assert ("roughcontact.contact.press", "make_problem") in taken


def test_what_stands_in_all_is_there():
    named = {
        module: importlib.import_module(module)
        for module in modules()
        if not module.endswith(("__main__", "cli.main"))
    }
    stale = {
        (module, name)
        for module, found in named.items()
        for name in getattr(found, "__all__", ())
        if not hasattr(found, name)
    }
    assert stale == set()


def test_each_base_name_stands_once():
    names = Counter(path.name for path in [*FILES, *THESIS] if path.name != "__init__.py")
    assert [name for name, count in names.items() if count > 1] == []


def test_each_public_class_stands_once():
    """Two classes of one name cannot be told apart in a message, a search or a page of documentation."""
    names = Counter(
        node.name
        for path in [*FILES, *THESIS]
        for node in house_sizes.tree(path).body
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_")
    )
    assert [name for name, count in names.items() if count > 1] == []
