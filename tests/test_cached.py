"""Properties that are computed once, without a lock."""

import copy
import pickle
from dataclasses import dataclass, field
from threading import Barrier, Thread

import pytest

from roughcontact.cached import cached_property


@dataclass(frozen=True, eq=False)
class Body:
    """A body that counts how often it is asked, and may have to wait for others that ask."""

    name: str
    asked: list[str] = field(default_factory=list)
    gate: Barrier | None = None

    @cached_property
    def answer(self):
        """What it is asked for."""
        self.asked.append(self.name)
        if self.gate is not None:
            self.gate.wait(30)
        return [self.name]


def test_it_is_computed_once():
    one, other = Body("one"), Body("other")
    assert one.answer is one.answer
    assert one.answer == ["one"] != other.answer
    assert one.asked == ["one"]


def test_without_an_instance_it_is_itself():
    assert isinstance(Body.answer, cached_property)
    assert Body.answer.__doc__ == "What it is asked for."


def test_what_fails_is_asked_again():
    class Failing:
        tries = 0

        @cached_property
        def answer(self):
            self.tries += 1
            if self.tries == 1:
                raise ArithmeticError("not yet")
            return self.tries

    failing = Failing()
    with pytest.raises(ArithmeticError, match="not yet"):
        _ = failing.answer
    assert failing.answer == 2


def test_all_who_ask_at_once_get_the_same():
    body, found = Body("slow", gate=Barrier(4)), []
    threads = [Thread(target=lambda: found.append(body.answer)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(30)
    assert len(body.asked) == 4
    assert [answer is body.answer for answer in found] == [True] * 4


def test_nobody_waits_for_another_instance():
    """With one lock for the class, as before Python 3.12, neither would ever come to the gate."""
    gate = Barrier(2)
    bodies = Body("one", gate=gate), Body("other", gate=gate)
    threads = [Thread(target=getattr, args=(body, "answer"), daemon=True) for body in bodies]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(30)
    assert [body.__dict__.get("answer") for body in bodies] == [["one"], ["other"]]


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda body: pickle.loads(pickle.dumps(body))])
def test_it_goes_along(copied):
    body = Body("one")
    _ = body.answer
    other = copied(body)
    assert other.answer == ["one"]
    assert other.asked == ["one"]
