"""A request is left where it is stopped, and nowhere else."""

import signal
import sys
import weakref

import pytest

from roughcontact.page.stopping import Stopped, Stopping


@pytest.fixture
def stopping():
    """The one of a worker, in this process; what it takes over is given back."""
    before = signal.getsignal(signal.SIGINT), sys.unraisablehook
    found = Stopping()
    found.install()
    yield found
    signal.signal(signal.SIGINT, before[0])
    sys.unraisablehook = before[1]


def test_the_order_that_is_worked_on_is_left(stopping):
    def worked():
        stopping.stop(1)
        for _ in range(10**6):
            pass

    stopping.begin(1)
    with pytest.raises(Stopped):
        worked()
    stopping.end()


def test_another_order_goes_on_and_one_that_is_yet_to_begin_does_not(stopping):
    stopping.begin(1)
    stopping.stop(2)
    for _ in range(10**4):
        pass
    stopping.end()
    with pytest.raises(Stopped):
        stopping.begin(2)
    stopping.end()


def test_nothing_is_raised_while_a_message_is_written(stopping):
    stopping.begin(1)
    stopping.pause()
    stopping.stop(1)
    for _ in range(10**4):
        pass
    with pytest.raises(Stopped):
        stopping.go_on()
    stopping.end()


def test_a_stop_that_python_swallows_is_not_lost(stopping, capfd):
    """In the callback of an object that is taken apart, of which Python would print a traceback."""

    class Anything:
        pass

    def callback(_):
        stopping.stop(1)
        for _ in range(10**4):
            pass

    stopping.begin(1)
    one = Anything()
    reference = weakref.ref(one, callback)
    del one
    assert reference() is None
    with pytest.raises(Stopped):
        stopping.check()
    stopping.end()
    assert capfd.readouterr() == ("", "")
