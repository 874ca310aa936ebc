"""What a command prints while it works."""

import io
import sys

import pytest

from roughcontact.cli.report import doing


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.parametrize(("stream", "shown"), [(Terminal, True), (io.StringIO, False)])
def test_only_a_terminal_shows_what_is_being_done(monkeypatch, stream, shown):
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(sys, "stderr", stream())
    with doing("Pressing 3 x 3 cells"):
        pass
    assert ("Pressing 3 x 3 cells" in sys.stderr.getvalue()) is shown
