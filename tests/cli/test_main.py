"""The program as a process of its own."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import roughcontact as rc

PROGRAM = [sys.executable, "-m", "roughcontact"]


def call(*arguments):
    words = [*PROGRAM, *map(str, arguments)]
    return subprocess.run(words, capture_output=True, encoding="utf-8", timeout=120, check=False)


def test_version():
    answer = call("--version")
    assert (answer.returncode, answer.stdout) == (0, f"roughcontact {rc.__version__}\n")


@pytest.mark.parametrize(
    ("verb", "options"),
    [
        ((), ["press", "curve", "surface"]),
        (
            ("press",),
            ["--force", "--pressure", "--depth", "--modulus", "--young", "--periodic", "--level", "--out"],
        ),
        (("curve",), ["--forces", "--pressures", "--depths", "--tolerance", "--json", "--channel", "--size"]),
        (("adhesion", "press"), ["--work", "--range", "--law", "--mean-gap", "--allow-unresolved"]),
        (("adhesion", "curve"), ["--depths", "--forces", "--pressures", "--mean-gaps", "--young", "--level"]),
        (("adhesion", "detach"), ["--force", "--depths", "--forces", "--work", "--tolerance"]),
        (("adhesion", "loop"), ["--depth", "--points", "--format", "--profile"]),
        (("surface", "info"), ["--json", "--unit"]),
        (
            ("surface", "make"),
            [
                "--hurst",
                "--rms",
                "--rms-band",
                "--points",
                "--rolloff",
                "--long-cutoff",
                "--short-cutoff",
                "--nodal",
            ],
        ),
    ],
)
def test_help_names_the_options_and_shows_examples(invoke, verb, options):
    answer = invoke(*verb, "--help")
    assert answer.exit_code == 0
    assert all(option in answer.stdout for option in options)
    assert (
        "70 a mistake" in answer.stdout if verb == () else f"roughcontact {' '.join(verb)} " in answer.stdout
    )


def test_an_option_that_there_is_not_is_bad_input():
    answer = call("press", "part.x3p", "--forec", "1N")
    assert answer.returncode == 2
    assert (
        answer.stderr == "Error: --forec: this command has no such option; did you mean --force or --free?\n"
    )
    assert "Traceback" not in answer.stderr


def test_json_is_all_there_is_on_standard_output(rough):
    answer = call("press", rough, "--force", "1mN", "--modulus", "1GPa", "--json")
    assert answer.returncode == 0
    assert answer.stdout.count("\n") == 1
    assert json.loads(answer.stdout)["force"] == pytest.approx(1e-3, rel=1e-10)
    assert "least-squares plane" in answer.stderr


def test_bad_input_is_one_line(tmp_path):
    answer = call("press", tmp_path / "missing.x3p", "--force", "1N", "--modulus", "1GPa", "--level", "none")
    assert (answer.returncode, answer.stdout) == (2, "")
    assert answer.stderr.startswith(f"Error: {tmp_path / 'missing.x3p'}: ")
    assert answer.stderr.count("\n") == 1


def script(*lines):
    """Run the program in a process that does some `lines` first."""
    program = "\n".join(["import sys", *lines, "from roughcontact.cli.main import run", "run()"])
    return [sys.executable, "-c", program]


def test_a_mistake_of_ours_has_its_own_status(rough):
    broken = script("import roughcontact as rc", "rc.press = None")
    words = [*broken, "press", str(rough), "--force", "1N", "--modulus", "1GPa"]
    answer = subprocess.run(words, capture_output=True, encoding="utf-8", timeout=120, check=False)
    assert answer.returncode == 70
    assert "Traceback" in answer.stderr
    assert "TypeError" in answer.stderr
    assert "mistake in roughcontact" in answer.stderr.splitlines()[-1]


def test_ctrl_c_during_the_imports_leaves_no_traceback():
    finder = (
        "class Finder:",
        "    def find_spec(self, name, path, target=None):",
        "        if name == 'typer': raise KeyboardInterrupt",
        "sys.meta_path.insert(0, Finder())",
    )
    words = [*script(*finder), "--version"]
    answer = subprocess.run(words, capture_output=True, encoding="utf-8", timeout=120, check=False)
    assert (answer.returncode, answer.stdout, answer.stderr) == (130, "", "Interrupted.\n")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
@pytest.mark.parametrize("words", [("--help",), ("surface", "info", "FILE"), ("--version",)])
def test_output_that_finds_no_room_is_one_line(rough, words):
    words = [*PROGRAM, *(str(rough) if word == "FILE" else word for word in words)]
    with open("/dev/full", "w") as full:
        answer = subprocess.run(words, stdout=full, stderr=subprocess.PIPE, encoding="utf-8", check=False)
    assert answer.returncode == 2
    assert answer.stderr == "Error: the output cannot be written: No space left on device\n"


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="names of files are letters there")
def test_a_file_whose_name_is_no_text(rough, tmp_path):
    path = os.fsencode(rough.parent) + b"/r\xff.npz"
    os.rename(rough, path)
    out = tmp_path / "out"
    program = script(
        "from pathlib import Path",
        "from matplotlib.figure import Figure",
        "Figure.savefig = lambda figure, path, **_: Path(path).touch()",
    )
    words = [*program, "press", os.fsdecode(path), "--force", "1mN", "--modulus", "1GPa", "--out", str(out)]
    answer = subprocess.run(words, capture_output=True, encoding="utf-8", timeout=120, check=False)
    assert answer.returncode == 0, answer.stderr
    record = json.loads((out / "press.json").read_text(encoding="utf-8"))
    assert record["file"].endswith("r?.npz")
    assert "r?.npz" in record["provenance"]["history"]
    assert record["surface"][0].startswith("read from r?.npz")
    assert sorted(each.name for each in out.iterdir()) == ["press.json", "pressure.nc", "pressure.png"]


@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
def test_sigterm_ends_a_run_and_leaves_nothing(rough, tmp_path):
    words = ["curve", rough, "--forces", "1uN:1N:100000", "--modulus", "1GPa", "--out", tmp_path / "out"]
    with subprocess.Popen(
        [*PROGRAM, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8"
    ) as process:
        assert "least-squares plane" in process.stderr.readline()  # it has begun
        assert (tmp_path / "out").is_dir()
        process.send_signal(signal.SIGTERM)
        stdout, stderr = process.communicate(timeout=60)
    assert process.returncode == 143
    assert stdout == ""
    assert "Terminated: no file was left half-written." in stderr
    assert "Traceback" not in stderr
    assert sorted(each.name for each in tmp_path.iterdir()) == ["rough.npz"]


@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
def test_ctrl_c_ends_a_run(rough, tmp_path):
    # A shell that starts a job in the background makes it deaf to Ctrl-C; a person's does not.
    script = (
        "import signal; signal.signal(signal.SIGINT, signal.default_int_handler); "
        "from roughcontact.__main__ import run; run()"
    )
    words = ["curve", rough, "--forces", "1uN:1N:100000", "--modulus", "1GPa", "--out", tmp_path / "out"]
    with subprocess.Popen(
        [sys.executable, "-c", script, *map(str, words)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
    ) as process:
        assert "least-squares plane" in process.stderr.readline()  # it has begun
        process.send_signal(signal.SIGINT)
        stdout, stderr = process.communicate(timeout=60)
    assert process.returncode == 130
    assert stdout == ""
    assert "Interrupted" in stderr
    assert "Traceback" not in stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
def test_ctrl_c_while_the_program_is_imported_ends_it_without_a_word():
    script = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
class Watch:
    def find_spec(self, name, *_):
        if name == "roughcontact.cli.main":
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Watch())
from roughcontact.__main__ import run; run()
"""
    answer = subprocess.run([sys.executable, "-c", script], capture_output=True, check=False, timeout=60)
    assert (answer.returncode, answer.stdout, answer.stderr) == (-signal.SIGINT, b"", b"")


@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
@pytest.mark.parametrize("words", [["-m", "roughcontact"], ["roughcontact"]])
def test_ctrl_c_while_the_package_is_imported_ends_the_program_without_a_word(words, tmp_path):
    """Sent from `sitecustomize`, at the first module that the package imports."""
    (tmp_path / "sitecustomize.py").write_text("""
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
class Watch:
    def find_spec(self, name, *_):
        if name == "roughcontact.late":
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Watch())
""")
    (tmp_path / "roughcontact").write_text("from roughcontact.__main__ import run; run()")
    (tmp_path / "mine.py").write_text("import roughcontact")
    path = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])
    given = {"capture_output": True, "check": False, "timeout": 60, "env": os.environ | {"PYTHONPATH": path}}
    words = [words[0] if len(words) == 2 else str(tmp_path / words[0]), *words[1:]]
    answer = subprocess.run([sys.executable, *words], **given)
    assert (answer.returncode, answer.stdout, answer.stderr) == (-signal.SIGINT, b"", b"")
    other = subprocess.run([sys.executable, str(tmp_path / "mine.py")], **given)
    assert b"KeyboardInterrupt" in other.stderr  # a script of a user keeps its handler


@pytest.mark.parametrize("words", [(), ("surface",), ("press", "--help-all")])
def test_flags_have_no_type_in_the_help(words, invoke):
    answer = invoke(*(words if "--help-all" in words else (*words, "--help")))
    assert "--help" in answer.stdout
    assert "bool" not in answer.stdout.casefold()


def test_help_waits_for_no_library_of_numerics():
    code = (
        "import sys; from roughcontact.cli.main import run; sys.argv[1:] = ['--help']\n"
        "try: run()\n"
        "except SystemExit: print({'numpy', 'scipy', 'matplotlib', 'pydantic'} & set(sys.modules))"
    )
    answer = subprocess.run([sys.executable, "-c", code], capture_output=True, encoding="utf-8", check=True)
    assert answer.stdout.endswith("set()\n")


@pytest.mark.parametrize("group", [[], ["adhesion"], ["surface"], ["study"]])
def test_help_of_a_group_holds_the_first_words_of_its_commands(group, invoke):
    told = invoke(*group, "--help").stdout
    lines = [line.strip("│|* ") for line in told.partition("Commands")[2].splitlines()[1:]]
    names = [line.split()[0] for line in lines if line and line[0].isalpha() and "  " in line]
    assert len(names) >= 4
    for name in set(names) - {"adhesion", "surface", "study"}:
        summary = next(line for line in lines if line.startswith(f"{name} ")).removeprefix(name).strip()
        assert summary[:40] in invoke(*group, name, "--help").stdout


def test_help_of_a_program_whose_text_is_not_there_is_the_same(monkeypatch, invoke):
    told = invoke("study", "--help").stdout
    monkeypatch.setattr("roughcontact.cli.late_group.find_spec", lambda name: None)
    assert invoke("study", "--help").stdout == told
