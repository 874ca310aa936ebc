"""A running `roughcontact serve`, as its user starts it, and requests to it without a browser."""

import contextlib
import http.client
import json
import os
import re
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import psutil

from roughcontact.page.frames import LENGTHS, header_of, lengths_of

PATIENCE = 120.0  # seconds that nothing takes, even on a machine that is busy with other things


@dataclass(frozen=True)
class Served:
    process: subprocess.Popen
    address: str
    folder: Path  # for all temporary files

    @property
    def port(self):
        return int(re.search(r":(\d+)/", self.address)[1])

    @property
    def token(self):
        return self.address.partition("token=")[2]

    @property
    def workers(self):
        return psutil.Process(self.process.pid).children(recursive=True)

    @property
    def log(self):
        return (self.folder / "log").read_text(encoding="utf-8")

    def left(self):
        """Return the files of the server and its workers that are there now, besides the lock of its folder."""
        try:
            found = [*self.folder.glob("roughcontact-*/**/*")]
        except FileNotFoundError:  # a folder that is removed while it is read
            return self.left()
        return [path for path in found if path.is_file() and path.name != "lock"]

    def sessions(self):
        """Return the keys of the sessions that are open."""
        return {path.name for path in self.folder.glob("roughcontact-page-*/*")} - {"scratch", "lock"}

    @contextlib.contextmanager
    def open(self, method, path, body=None, headers=(), *, host=None):
        """Yield the answer, of which nothing is read yet."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        with (
            contextlib.closing(connection),
            self._asked(connection, method, path, body, headers, host) as found,
        ):
            yield found

    def _asked(self, connection, method, path, body, headers, host):
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        connection.putheader("Host", host or f"127.0.0.1:{self.port}")
        connection.putheader("Cookie", f"roughcontact-{self.port}={self.token}")
        for name, value in headers:
            connection.putheader(name, value)
        if body is not None:
            connection.putheader("Content-Length", str(len(body)))
        connection.endheaders(body)
        return connection.getresponse()

    def ask(self, method, path, body=None, headers=(), *, host=None):
        """Return the status and what was answered."""
        with self.open(method, path, body, headers, host=host) as response:
            return response.status, response.read()

    def begin(self):
        """Return the key of a new session."""
        status, words = self.ask("POST", "/session")
        assert status == 200, words
        return json.loads(words)["session"]

    def put(self, session, name, content):
        """Return what the page would call a file that is dropped."""
        status, words = self.ask("PUT", f"/file?session={session}&name={name}", content)
        assert status == 200, words
        return json.loads(words)["file"]

    def request(self, session, job, recipe, *, queue="front", key="1", more=None):
        """Yield the messages that answer a request, as their headers."""
        asked = {"queue": queue, "job": job, "recipe": recipe, "more": more or {}, "key": key}
        with self.open("POST", f"/request?session={session}", json.dumps(asked).encode()) as response:
            assert response.status == 200
            while start := response.read(LENGTHS):
                words, data = lengths_of(start)
                yield header_of(response.read(words))
                response.read(data)


def started(folder, *arguments):
    """Return a server whose temporary files lie in a folder."""
    with (folder / "log").open("w") as log:
        process = subprocess.Popen(
            [sys.executable, "-m", "roughcontact", "serve", "--no-browser", *arguments],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=log,
            text=True,
            env=os.environ | dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder)),
        )
    address = process.stdout.readline().strip()
    served = Served(process, address, folder)
    assert address.startswith("http://127.0.0.1:"), served.log
    return served


def ended(served, how=signal.SIGINT):
    """End a server by a signal; return its status."""
    served.process.send_signal(how)
    try:
        return served.process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        served.process.kill()
        served.process.wait()
        raise
    finally:
        served.process.stdout.close()


def opened_again(page, address):
    """Show the page as a new tab would, in the session of what it showed before.

    A new session takes two processes, each of which presses maps before its first request: most of the time of a test.
    """
    if page.url != "about:blank":
        # The page notes its session and its state when it is left; this listener comes after its own.
        page.evaluate(
            """() => addEventListener("pagehide", () => {
              const { session } = JSON.parse(sessionStorage.getItem("roughcontact"));
              sessionStorage.setItem("roughcontact", JSON.stringify({ session }));
            })"""
        )
    page.goto(address)
