"""A property that is computed on first access, and kept."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, TypeVar, overload

__all__ = ["cached_property"]

T = TypeVar("T", covariant=True)


class cached_property(Generic[T]):  # noqa: N801  # used as the one of the standard library
    """A method that becomes an attribute: computed once, on first access, then kept in the instance's dictionary.

    It takes no lock. Before Python 3.12, `functools.cached_property` has one lock for all instances of a class: a
    thread waits while another computes the property of another instance, and a process that is forked meanwhile
    deadlocks. Here concurrent threads all compute the property, and all get the object that was ready first.

    The class needs a ``__dict__``; it may be a frozen dataclass, but without slots. The value is copied and pickled
    with the instance.
    """

    def __init__(self, function: Callable[[Any], T]) -> None:
        self._function = function
        self._name = function.__name__
        self.__doc__ = function.__doc__

    def __set_name__(self, owner: type[Any], name: str) -> None:
        self._name = name

    @overload
    def __get__(self, instance: None, owner: type[Any] | None = None) -> cached_property[T]: ...

    @overload
    def __get__(self, instance: object, owner: type[Any] | None = None) -> T: ...

    def __get__(self, instance: object, owner: type[Any] | None = None) -> Any:
        if instance is None:
            return self
        # Called only once, because Python reads the dictionary first. Setting a default is atomic for threads.
        return vars(instance).setdefault(self._name, self._function(instance))
