"""How a worker ends a request: done, refused, or with a mistake of this program, and never with a crash."""

import json
import subprocess
import sys

import numpy as np
import pytest

from roughcontact import progress
from roughcontact.page import page_worker
from roughcontact.page.jobs.session_cache import SessionCache
from roughcontact.page.stopping import Stopping

MADE = {"kind": "self-affine", "hurst": "0.8", "rms": "0.1um", "size": "32um", "points": "32"}
BODIES = {"modulus": "110 GPa"}
GREEDY = """
import numpy as np
from roughcontact.memory import free_memory
from roughcontact import progress
from roughcontact.page import page_worker

page_worker._limit_memory()
try:
    np.zeros(int(0.9 * free_memory()), dtype=np.uint8)  # nothing of it is touched: the machine would give it
except MemoryError:
    print("refused")
"""


def end_of(job, recipe=None, cache=None):
    """Return the last message that answers a request."""
    return sent_by(job, recipe, cache)[-1]


def sent_by(job, recipe=None, cache=None):
    """Return all messages that answer a request."""
    sent = []
    request = {
        "number": 1,
        "job": job,
        "recipe": recipe or {"job": "surface", "source": MADE},
        "files": {},
        "more": {},
    }
    page_worker.perform(
        request, cache or SessionCache(), lambda header, data=b"": sent.append(header), Stopping()
    )
    return sent


@pytest.mark.parametrize(
    ("job", "more", "tasks"),
    [
        ("look", {"job": "surface"}, {"Adding up the waves of 32 x 32 cells"}),
        (
            "press",
            {"job": "press", "bodies": BODIES, "load": {"pressure": "1MPa"}},
            {"Pressing 32 x 32 cells"},
        ),
        (
            "curve",
            {"job": "curve", "bodies": BODIES},
            {"Finding the loads that suit the surface", "Pressing"},
        ),
        ("curve", {"job": "curve", "bodies": BODIES, "loads": {"pressures": "1MPa,2MPa"}}, {"Pressing"}),
    ],
)
def test_how_far_it_is_goes_before_the_end(job, more, tasks):
    sent = sent_by(job, {"source": MADE, **more})
    told = [header for header in sent if header["type"] == "progress" and not header["level"]]
    assert sent[-1] == {"type": "end", "how": "done"}
    assert tasks <= {header["task"] for header in told}
    for name in tasks:
        states = [header["state"] for header in told if header["task"] == name]
        assert (states[0], states[-1]) == ("started", "finished")
    json.dumps(sent, allow_nan=False)


def test_nobody_listens_when_an_order_is_answered():
    end_of("look")
    with progress.task("Trying") as here:
        assert here is None


def test_an_order_that_is_answered_is_done():
    assert end_of("look") == {"type": "end", "how": "done"}


@pytest.mark.parametrize(
    ("job", "recipe", "words"),
    [
        ("dig", None, "no job 'dig'"),
        (
            "look",
            {"job": "surface", "source": {"kind": "self-affine"}},
            "hurst is missing",
        ),
        ("look", {"job": "surface", "source": {**MADE, "points": 10**6}}, "at most 4096 points"),
        (
            "look",
            {"job": "surface", "source": {"kind": "file", "file": "/etc/passwd"}},
            "no longer has this file",
        ),
        ("look", {"job": "dig", "source": MADE}, "no job 'dig'"),
        ("press", {"job": "press", "source": MADE, "bodies": BODIES, "load": {"force": "much"}}, "much"),
    ],
)
def test_what_cannot_be_done_is_refused_with_the_reason(job, recipe, words):
    end = end_of(job, recipe)
    assert end["how"] == "refused"
    assert words.lower() in end["message"].lower()


def test_a_lack_of_memory_is_refused_and_what_was_kept_is_let_go_of(monkeypatch):
    def look(request, cache, send):
        cache.kept["surface"] = {"key": "large"}
        raise MemoryError

    monkeypatch.setattr(page_worker, "_job", lambda name: look)
    cache = SessionCache()
    end = end_of("look", cache=cache)
    assert end["how"] == "refused"
    assert "memory" in end["message"]
    assert cache.kept == {}


def test_a_mistake_of_ours_is_said_and_its_traceback_shown(monkeypatch, capfd):
    def look(request, cache, send):
        np.zeros(3).reshape(2)

    monkeypatch.setattr(page_worker, "_job", lambda name: look)
    end = end_of("look")
    assert end["how"] == "mistake"
    assert "not in your input" in end["message"]
    assert "Traceback" in capfd.readouterr().err


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux limits the address space of a process")
def test_a_worker_takes_no_more_memory_than_there_is():
    found = subprocess.run([sys.executable, "-c", GREEDY], capture_output=True, text=True, check=True)
    assert found.stdout == "refused\n"
