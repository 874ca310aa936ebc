"""The process that computes for a page: requests in on standard input, messages out on standard output.

It ends with the server: standard input is closed then.
"""

from __future__ import annotations

import contextlib
import io
import logging
import os
import sys
import threading
import traceback
from collections.abc import Iterator, Mapping
from dataclasses import asdict
from pathlib import Path
from queue import SimpleQueue
from typing import Any, BinaryIO

from roughcontact.errors import InputError
from roughcontact.page.frames import LENGTHS, header_of, lengths_of, packed
from roughcontact.page.jobs.session_cache import SessionCache, UploadedFile
from roughcontact.page.server.page_request import PageJob, PageRequest, Send
from roughcontact.page.stopping import Stopped, Stopping
from roughcontact.progress.events import listening

__all__ = ["main", "perform"]

_SHARE = 0.75  # of the memory that is free at the start
_INTERVAL = 0.3  # seconds between two messages on the progress of a task


def main() -> None:
    """Compute until standard input ends."""
    requests: BinaryIO = os.fdopen(os.dup(0), "rb")
    answers: BinaryIO = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # output of third-party readers must not be taken for an answer
    stopping, inbox, cache = Stopping(), SimpleQueue[dict[str, Any]](), SessionCache()
    stopping.install()
    threading.Thread(target=_listen, args=(requests, stopping, inbox), daemon=True).start()
    logging.disable(logging.CRITICAL)
    warming = _warm_up()
    next(warming)
    _limit_memory()

    def send(header: Mapping[str, Any], data: bytes = b"") -> None:
        stopping.pause()
        answers.write(packed(header, data))
        answers.flush()
        if stopping.running is not None:
            stopping.go_on()

    with contextlib.suppress(BrokenPipeError):
        send({"type": "ready"})
        for _ in warming:
            if not inbox.empty():  # a request must not wait for the rest
                break
        while True:
            perform(inbox.get(), cache, send, stopping)


def perform(given: Mapping[str, Any], cache: SessionCache, send: Send, stopping: Stopping) -> None:
    """Answer a request, and send its outcome: done, stopped, refused with a reason, or a defect of this program.

    Messages of the type "progress" are sent before it.
    """
    end: dict[str, Any] = {"type": "end", "how": "done"}
    try:
        stopping.begin(given["number"])
        request = _request(given)
        with (
            contextlib.redirect_stdout(io.StringIO()),
            listening(lambda event: send({"type": "progress", **asdict(event)}), interval=_INTERVAL),
        ):
            _job(given["job"])(request, cache, send)
    except Stopped:
        end["how"] = "stopped"
    except MemoryError:
        cache.kept.clear()
        end |= {
            "how": "refused",
            "message": "The map has too many points for the free memory. Crop or Downsample it.",
        }
    except Exception as error:
        from roughcontact.page.refusal import refusal

        end |= refusal(error)
        if end["how"] == "mistake":
            traceback.print_exc(file=sys.stderr)
    finally:
        stopping.end()
    send(end)


def _request(given: Mapping[str, Any]) -> PageRequest:
    files = {key: UploadedFile(Path(each["path"]), each["name"]) for key, each in given["files"].items()}
    return PageRequest.of(given["recipe"], files, given.get("more") or {})


def _job(name: str) -> PageJob:
    from roughcontact.page.jobs.bodies_job import bodies
    from roughcontact.page.jobs.curve_jobs import curve, theories
    from roughcontact.page.jobs.export_job import export
    from roughcontact.page.jobs.press_jobs import cut, press
    from roughcontact.page.jobs.surface_jobs import look, study

    jobs: dict[str, PageJob] = {
        each.__name__: each for each in (look, study, bodies, press, cut, curve, theories, export)
    }
    if name not in jobs:
        raise InputError(f"there is no job {name!r}")
    return jobs[name]


def _listen(requests: BinaryIO, stopping: Stopping, inbox: SimpleQueue[dict[str, Any]]) -> None:
    while len(start := requests.read(LENGTHS)) == LENGTHS:
        given = header_of(requests.read(lengths_of(start)[0]))
        if "stop" in given:
            stopping.stop(given["stop"])
        else:
            inbox.put(given)
    os._exit(0)  # the server has ended; a computation is dropped


def _warm_up() -> Iterator[None]:
    """Load in steps what requests need: modules, units, and the machine code of the solvers."""

    def asked(job: str, points: str, **more: Any) -> dict[str, Any]:
        made = {"kind": "self-affine", "hurst": "0.8", "rms": "0.1um", "size": "0.5mm", "points": points}
        return {"job": job, "source": made, **more}

    def pressed(points: str, pressure: str) -> dict[str, Any]:
        return asked("press", points, bodies={"modulus": "100GPa"}, load={"pressure": pressure})

    # Large enough for every method of the solvers.
    steps: list[tuple[str, dict[str, Any]]] = [
        ("look", asked("surface", "64")),
        *(("press", pressed(*load)) for load in (("64", "0.1MPa"), ("512", "0.1MPa"), ("512", "10MPa"))),
        ("study", asked("surface", "64")),
    ]
    cache = SessionCache()
    for job, recipe in steps:
        _job(job)(_request({"recipe": recipe, "files": {}}), cache, _unsent)
        yield


def _unsent(header: Mapping[str, Any], data: bytes = b"") -> None:
    """Send nothing."""


def _limit_memory() -> None:
    """Limit the memory of this process, so that a huge file raises an error rather than stopping the machine."""
    if sys.platform == "linux":  # elsewhere the address space is a poor measure
        import resource

        import psutil

        from roughcontact.memory import free_memory

        most = psutil.Process().memory_info().vms + int(_SHARE * free_memory())
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (most if hard < 0 else min(most, hard), hard))


if __name__ == "__main__":
    main()
