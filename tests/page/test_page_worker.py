"""How a worker ends a request: done, refused, or with a mistake of this program, and never with a crash."""

import subprocess
import sys

import numpy as np
import pytest

from roughcontact.page import page_worker
from roughcontact.page.jobs.session_cache import SessionCache
from roughcontact.page.stopping import Stopping

MADE = {"kind": "made", "hurst": "0.8", "rms": "0.1um", "size": "32um", "points": 32}
GREEDY = """
import numpy as np
from roughcontact.memory import free_memory
from roughcontact.page import page_worker

page_worker._limit_memory()
try:
    np.zeros(int(0.9 * free_memory()), dtype=np.uint8)  # nothing of it is touched: the machine would give it
except MemoryError:
    print("refused")
"""


def end_of(job, recipe=None, cache=None):
    """Return the last message that answers a request."""
    sent = []
    request = {"number": 1, "job": job, "recipe": recipe or {"source": MADE}, "files": {}, "more": {}}
    page_worker.perform(
        request, cache or SessionCache(), lambda header, data=b"": sent.append(header), Stopping()
    )
    return sent[-1]


def test_an_order_that_is_answered_is_done():
    assert end_of("look") == {"type": "end", "how": "done"}


@pytest.mark.parametrize(
    ("job", "recipe", "words"),
    [
        ("dig", None, "no job 'dig'"),
        (
            "look",
            {"source": {"kind": "made"}},
            "the request is wrong at source.MadeSource.hurst: Field required",
        ),
        ("look", {"source": {**MADE, "points": 10**6}}, "3 to 4096 points"),
        ("look", {"source": {"kind": "file", "file": "/etc/passwd"}}, "no such file"),
        ("press", {"source": MADE, "load": {"control": "force", "text": "much"}}, "much"),
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
