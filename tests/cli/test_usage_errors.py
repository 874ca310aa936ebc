"""What the parser of options refuses: in the same form as every other error, without words of its libraries."""

import json

import pytest

JOB = ("press", "FILE", "--force", "1N", "--modulus", "1GPa")


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (("press", "FILE", "--froce", "1N"), "--froce: this command has no such option; did you mean --force"),
        (("press", "FILE", "--load", "1N"), "--load: this command has no such option; use --pressure or --force"),
        (("curve", "FILE", "--loads", "1N"), "--loads: this command has no such option; use --pressures"),
        (("press", "FILE", "--xyzzy"), "--xyzzy: this command has no such option; choose one that"),
        (("press", "FILE", "--force"), "--force: the value is missing; write --force 10N"),
        (("press", "FILE", "--periodic=1"), "--periodic: this option takes no value; write only --periodic"),
        (("press", "FILE", "10", "N"), "unexpected argument '10 N': put quotes around a value"),
        (("press",), "FILE is missing: write a line such as: roughcontact press part.x3p --force 10N"),
        (("surface", "make", "a.npz"), "--hurst is required: add it, such as --hurst 0.8"),
        (("study", "export", "results"), "--out is required: add it, such as --out FILE"),
        (("pres",), "'roughcontact' has no command 'pres': did you mean 'press'? choose from"),
        (("surface", "inof"), "'roughcontact surface' has no command 'inof': did you mean 'info'?"),
        (("-q", "press"), "-q: this command has no such option; write it after the name of a command"),
        ((*JOB, "--format", "gif"), "--format: 'gif' is not one of the choices; choose from png, pdf, svg"),
        ((*JOB, "--progress", "bars"), "--progress: 'bars' is not one of the choices; choose from auto, json, none"),
        ((*JOB, "-q", "-v"), "--quiet and --verbose exclude each other: give one of them"),
        (("serve", "--port", "80"), "--port: a port must be a whole number from 1024 to 65535, not '80'"),
        (("study", "run", "s.toml", "--workers", "0"), "--workers: the number of workers must be a whole number"),
        (("study", "run", "s.toml", "--executor", "gpu"), "--executor: 'gpu' is not one of the choices"),
        (("study", "from", "j.toml", "--out", "s.toml", "--samples", "0"), "--samples: the number of samples must"),
    ],
)  # fmt: skip
def test_an_error_says_where_what_and_what_to_write(invoke, rough, words, line):
    given = [str(rough) if word == "FILE" else word for word in words]
    answer = invoke(*given)
    assert answer.exit_code == 2
    assert answer.stderr.startswith(f"Error: {line}")
    assert answer.stderr.count("\n") == 1
    assert answer.stdout == ""


@pytest.mark.parametrize(
    ("words", "place", "remedy"),
    [
        (("press", "--json"), "FILE", "write a line such as: "),
        (("surface", "make", "a.npz", "--json"), "--hurst", "add it, such as --hurst 0.8"),
        (("pres", "--json"), None, "did you mean 'press'? "),
        (("study", "add", "results", "--samples", "x", "--json"), "--samples", "give one such as 2"),
    ],
)
def test_for_programs_an_error_has_its_place_and_its_remedy(invoke, words, place, remedy):
    answer = invoke(*words)
    error = json.loads(answer.stdout)["error"]
    assert (error["kind"], error["place"]) == ("usage", place)
    assert error["remedy"].startswith(remedy)


def test_a_group_alone_shows_its_help_once(invoke):
    assert invoke("surface").stdout.count("Usage:") == 1


def test_quiet_leaves_remarks_out_and_keeps_what_makes_a_number_wrong(invoke, rough):
    told, quiet = invoke(*JOB[:1], rough, *JOB[2:]), invoke(*JOB[:1], rough, *JOB[2:], "-q")
    assert quiet.stdout == told.stdout
    assert "the tilt is removed" in told.stderr
    assert "the tilt is removed" not in quiet.stderr
    assert "the reduced modulus: real bodies yield" in quiet.stderr


def test_verbose_says_what_is_done(invoke, rough):
    steps, usual = (invoke(*JOB[:1], rough, *JOB[2:], *option).stderr for option in (["-v"], []))
    assert "Levelling: 0.0" in steps
    assert "Levelling:" not in usual
