"""Bad input is one line; a mistake of ours shows itself."""

import warnings
from types import SimpleNamespace

import numpy as np
import psutil
import pytest
import typer

import roughcontact as rc
from roughcontact import memory
from roughcontact.cli.exits import BAD_INPUT, INTERRUPTED
from roughcontact.cli.messages import UsageError, note, reported
from roughcontact.cli.run_memory import require_memory
from roughcontact.files import read as read_module
from roughcontact.files.file_errors import SurfaceWarning


def planted(source, name="f"):
    """Return the function of `source` as if it stood in a module of the package, in a bundle of a program."""
    space = {"__name__": "roughcontact.contact.planted"}
    exec(compile(source, "roughcontact/contact/planted.py", "exec"), space)
    return space[name]


def test_an_error_that_the_package_raises_is_one_line(capsys):
    with pytest.raises(typer.Exit) as caught, reported():
        rc.Grid((0, 3), 1.0)
    assert caught.value.exit_code == BAD_INPUT
    error = capsys.readouterr().err
    assert error.startswith("Error: shape must hold positive whole numbers")
    assert error.count("\n") == 1


def test_a_file_that_the_system_refuses_is_one_line(tmp_path, capsys):
    with pytest.raises(typer.Exit) as caught, reported():
        (tmp_path / "missing").read_text()
    assert caught.value.exit_code == BAD_INPUT
    assert capsys.readouterr().err == f"Error: {tmp_path / 'missing'}: No such file or directory\n"


@pytest.mark.parametrize(
    ("source", "error"),
    [
        ("def f():\n import numpy\n return numpy.zeros(-1)", ValueError),  # raised by compiled code
        ("def f():\n return int('many')", ValueError),
        ("def f():\n import numpy\n return numpy.linalg.inv(1)", ValueError),  # raised by code in Python
        ("def f():\n try:\n  int('many')\n except ValueError:\n  raise", ValueError),
        ("def f():\n return {}['key']", KeyError),
        ("def f():\n raise TypeError('one', 'two')", TypeError),
        ("def f():\n raise OSError('strange')", OSError),
        ("def f():\n raise ValueError('of no class of ours')", ValueError),
        ("def f():\n from roughcontact import InputError\n raise InputError('strange')", None),
    ],
)
def test_foreign_errors_show_themselves_as_mistakes_of_ours(source, error):
    with pytest.raises(typer.Exit if error is None else error), reported():
        planted(source)()


def test_a_reader_of_our_output_that_has_gone_is_no_bad_input():
    with pytest.raises(BrokenPipeError), reported():
        raise BrokenPipeError(32, "Broken pipe", "stdout")


def test_an_interrupt_ends_with_the_status_of_a_shell(capsys):
    with pytest.raises(typer.Exit) as caught, reported():
        raise KeyboardInterrupt
    assert caught.value.exit_code == INTERRUPTED
    assert capsys.readouterr().err == "Interrupted: no file was left half-written.\n"


def test_no_room_in_memory_is_one_line(capsys):
    with pytest.raises(typer.Exit) as caught, reported():
        raise MemoryError
    assert caught.value.exit_code == BAD_INPUT
    assert capsys.readouterr().err.startswith("Error: the memory does not suffice")


def test_warnings_of_ours_become_notes_and_others_stay_what_they_are(capsys):
    with reported():
        warnings.warn("part.x3p: two channels; pass channel= for another", SurfaceWarning, stacklevel=1)
    assert capsys.readouterr().err == "Note: part.x3p: two channels; pass --channel for another\n"
    with pytest.warns(RuntimeWarning, match="foreign"), reported():
        warnings.warn("foreign", RuntimeWarning, stacklevel=1)


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("pass size= with the width", "pass --size with the width"),
        ("such as size='5 um' or size=(4e-4, 5e-4)", "such as --size '5 um' or --size '4e-4 x 5e-4'"),
        ("pass unit= with a unit, such as unit='um'", "pass --unit with a unit, such as --unit 'um'"),
        ("several\n   lines", "several lines"),
        ("1.86e-06 m, 2e-05 m (3.25e-10 m)", "1.86 um, 20 um (325 pm)"),
        ("1e-06 m^2 and 2e-03 m/s and 0.5 m", "1e-06 m^2 and 2e-03 m/s and 0.5 m"),
    ],
)
def test_keywords_become_options_in_one_line(text, line, capsys):
    note(text)
    assert capsys.readouterr().err == f"Note: {line}\n"


class TestMemory:
    @pytest.fixture(autouse=True)
    def _machine(self, monkeypatch):
        monkeypatch.setattr(psutil, "virtual_memory", lambda: SimpleNamespace(available=8e9))

    def test_a_run_beyond_the_machine_is_refused(self):
        with pytest.raises(UsageError, match=r"10000 x 20000 cells needs 38 GB of memory, and 8 GB are free"):
            require_memory(38_000_000_000, (10000, 20000))

    def test_a_big_run_is_announced(self, capsys):
        require_memory(7_900_000_000, (100, 100))
        assert capsys.readouterr().err == (
            "Note: a grid of 100 x 100 cells needs about 7.9 GB of memory; 8 GB are free\n"
        )

    def test_a_small_run_passes_in_silence(self, capsys):
        require_memory(10_000_000, (100, 100))
        assert capsys.readouterr().err == ""

    def test_press_and_make_ask_before_they_work(self, invoke, rough, monkeypatch, tmp_path):
        monkeypatch.setattr(psutil, "virtual_memory", lambda: SimpleNamespace(available=1000))
        monkeypatch.setattr(rc, "press", lambda *_, **__: pytest.fail("it went to work"))
        monkeypatch.setattr(rc, "self_affine", lambda *_, **__: pytest.fail("it went to work"))
        made = ("surface", "make", tmp_path / "new.npz", "--hurst", "1", "--rms", "1um", "--size", "1mm")
        for words in (("press", rough, "--force", "1mN", "--modulus", "1GPa"), made):
            answer = invoke(*words)
            assert answer.exit_code == BAD_INPUT
            assert "of memory" in answer.stderr
        assert not (tmp_path / "new.npz").exists()

    @pytest.mark.parametrize("verb", ["info", "press", "curve"])
    def test_a_map_beyond_the_machine_is_refused_before_it_is_read(self, invoke, monkeypatch, tmp_path, verb):
        path = sparse(tmp_path / "huge.npy", (20000, 20000))
        words = {
            "info": ("surface", "info", path),
            "press": ("press", path, "--force", "1N", "--modulus", "1GPa"),
            "curve": ("curve", path, "--modulus", "1GPa"),
        }[verb]
        answer = invoke(*words, "--unit", "um", "--size", "1mm")
        assert answer.exit_code == BAD_INPUT
        # 1.6 GB of file and a hundred bytes for each of 4e8 points.
        assert answer.stderr == (
            f"Error: {path}: reading it needs 41.6 GB of memory, and 8 GB are free; "
            "cut the map or subsample it, or use a machine with more memory\n"
        )

    @pytest.mark.parametrize("verb", ["press", "curve"])
    def test_a_surface_that_was_read_may_be_too_large_to_press(self, invoke, rough, monkeypatch, verb):
        monkeypatch.setattr(memory, "SMALL", 0)
        words = (verb, rough, "--force" if verb == "press" else "--forces", "1mN", "--modulus", "1GPa")
        monkeypatch.setattr(memory, "most_memory", lambda: 6e3)
        answer = invoke(*words)
        assert answer.exit_code == BAD_INPUT
        assert "Error: a load on 24 x 32 cells needs 6.91e-06 GB of memory at least" in answer.stderr
        monkeypatch.setattr(memory, "most_memory", lambda: 6e4)
        answer = invoke(*words)
        assert answer.exit_code == 0
        assert (
            f"Note: a {'load' if verb == 'press' else 'curve'} on 24 x 32 cells needs up to 0.009"
            in answer.stderr
        )

    def test_info_asks_before_it_levels(self, invoke, rough, monkeypatch):
        read = read_module.read_either

        def then_another_program_takes_it(*given, **named):
            surface = read(*given, **named)
            monkeypatch.setattr(psutil, "virtual_memory", lambda: SimpleNamespace(available=1e3))
            return surface

        monkeypatch.setattr(read_module, "read_either", then_another_program_takes_it)
        monkeypatch.setattr(rc.Surface, "levelled", lambda *_: pytest.fail("it went to level"))
        answer = invoke("surface", "info", rough)
        assert answer.exit_code == BAD_INPUT
        assert "a grid of 24 x 32 cells needs" in answer.stderr


def sparse(path, shape):
    """Return a NumPy file of zeros that takes no room on the disk."""
    header = {"descr": "<f4", "fortran_order": False, "shape": shape}
    with open(path, "wb") as stream:
        np.lib.format.write_array_header_1_0(stream, header)
        stream.truncate(stream.tell() + 4 * shape[0] * shape[1])
    return path
