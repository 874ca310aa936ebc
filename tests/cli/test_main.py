"""The program as a process of its own."""

import json
import signal
import subprocess
import sys

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
        (("surface", "info"), ["--json", "--unit"]),
        (
            ("surface", "make"),
            ["--hurst", "--rms", "--points", "--rolloff", "--cutoff", "--short", "--nodal"],
        ),
    ],
)
def test_help_names_the_options_and_shows_examples(invoke, verb, options):
    answer = invoke(*verb, "--help")
    assert answer.exit_code == 0
    assert all(option in answer.stdout for option in options)
    assert (
        "Exit status" in answer.stdout if verb == () else f"roughcontact {' '.join(verb)} " in answer.stdout
    )


def test_an_option_that_there_is_not_is_bad_input():
    answer = call("press", "part.x3p", "--forec", "1N")
    assert answer.returncode == 2
    assert "No such option: --forec" in answer.stderr
    assert "Traceback" not in answer.stderr


def test_json_is_all_there_is_on_standard_output(rough):
    answer = call("press", rough, "--force", "1mN", "--modulus", "1GPa", "--json")
    assert answer.returncode == 0
    assert answer.stdout.count("\n") == 1
    assert json.loads(answer.stdout)["force"] == pytest.approx(1e-3, rel=1e-10)
    assert "levelled" in answer.stderr


def test_bad_input_is_one_line(tmp_path):
    answer = call("press", tmp_path / "missing.x3p", "--force", "1N", "--modulus", "1GPa", "--level", "none")
    assert (answer.returncode, answer.stdout) == (2, "")
    assert answer.stderr.startswith("Error: missing.x3p: ")
    assert answer.stderr.count("\n") == 1


@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
def test_ctrl_c_ends_a_run(rough, tmp_path):
    # A shell that starts a job in the background makes it deaf to Ctrl-C; a person's does not.
    script = (
        "import signal; signal.signal(signal.SIGINT, signal.default_int_handler); "
        "from roughcontact.cli.main import run; run()"
    )
    words = ["curve", rough, "--forces", "1uN:1N:100000", "--modulus", "1GPa", "--out", tmp_path / "out"]
    with subprocess.Popen(
        [sys.executable, "-c", script, *map(str, words)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
    ) as process:
        assert "levelled" in process.stderr.readline()  # it has begun
        process.send_signal(signal.SIGINT)
        stdout, stderr = process.communicate(timeout=60)
    assert process.returncode == 130
    assert stdout == ""
    assert "Interrupted" in stderr
    assert "Traceback" not in stderr
    assert not (tmp_path / "out").exists()
