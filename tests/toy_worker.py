"""A worker of the page that is ready at once, and whose jobs are toys."""

import contextlib
import os
import signal
import time

from roughcontact.page import page_worker
from roughcontact.page.stopping import Stopped


def say(request, cache, send):
    """Send the number of the process, and what was asked for besides."""
    send({"type": "said", "process": os.getpid(), "more": request["more"]}, bytes(1000))


def work(request, cache, send):
    """Never end by itself."""
    send({"type": "doing"})
    while True:
        time.sleep(0.001)


def ignore(request, cache, send):
    """Never end by itself, and not when it is stopped."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with contextlib.suppress(Stopped):  # which is raised behind a message
        send({"type": "doing"})
    while True:
        time.sleep(10)


def flood(request, cache, send):
    """Send more than pipes hold, until it is stopped."""
    while True:
        send({"type": "doing"}, bytes(2**20))


def die(request, cache, send):
    """End the process in the middle of an answer."""
    send({"type": "doing"})
    os._exit(1)


if __name__ == "__main__":
    jobs = {each.__name__: each for each in (say, work, ignore, flood, die)}
    page_worker._warm_up = lambda: iter([None])
    page_worker._request = lambda given: given
    page_worker._job = jobs.__getitem__
    page_worker.main()
