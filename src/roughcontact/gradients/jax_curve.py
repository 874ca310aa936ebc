"""A differentiable curve as a function of JAX: calls of the host, and the rule of its derivatives."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from threading import Lock
from typing import Any

import numpy as np

from roughcontact.gradients.linearised import no_second_derivative

__all__ = ["jax_values"]

WAITING = 8  # most forward passes whose linearisations are kept for their backward passes

_lock = Lock()
_waiting: dict[Any, Callable[..., Any]] = {}  # no backward pass has used these
_used: dict[
    Any, Callable[..., Any]
] = {}  # kept until the next forward pass, because Jacobians use one several times


def jax_values(linearise: Callable[[Any], Any], count: int, heights: Any) -> tuple[Any, ...]:
    """Return the values of a linearised function of heights, each of `count` numbers, as arrays of JAX."""
    return _differentiable()(linearise, count, heights)  # type: ignore[no-any-return]


def _values(linearise: Callable[[Any], Any], kept: bool, given: Any) -> tuple[Any, ...]:
    heights = np.asarray(given)
    values, pullback = linearise(heights)
    if kept:
        with _lock:
            _used.clear()
            _waiting[linearise, heights.tobytes()] = pullback
            while len(_waiting) > WAITING:
                del _waiting[next(iter(_waiting))]
    return tuple(value.astype(heights.dtype) for value in values)


def _pulled_back(linearise: Callable[[Any], Any], given: Any, derivatives: Any) -> Any:
    heights = np.asarray(given)
    key = linearise, heights.tobytes()
    with _lock:
        pullback = _used.get(key) or _waiting.pop(key, None)
    pullback = pullback or linearise(heights)[1]
    with _lock:
        _used[key] = pullback
    return pullback(*map(np.asarray, derivatives)).astype(heights.dtype)


@cache
def _differentiable() -> Any:
    """Return the function with its rule; JAX is imported at its first use."""
    import jax

    on_host = partial(jax.pure_callback, vmap_method="sequential")

    def values(kept: bool, linearise: Any, count: int, heights: Any) -> Any:
        shape = jax.ShapeDtypeStruct((count,), heights.dtype)
        return on_host(partial(_values, linearise, kept), (shape,) * 4, heights)

    def pulled_back(linearise: Any, heights: Any, derivatives: Any) -> Any:
        shape = jax.ShapeDtypeStruct(heights.shape, heights.dtype)
        return on_host(partial(_pulled_back, linearise), shape, heights, derivatives)

    def refuse(*_: Any) -> Any:
        raise no_second_derivative()

    forward = jax.custom_jvp(partial(values, True), nondiff_argnums=(0, 1))
    backward = jax.custom_jvp(pulled_back, nondiff_argnums=(0,))
    forward.defjvp(refuse)
    backward.defjvp(refuse)
    differentiable = jax.custom_vjp(partial(values, False), nondiff_argnums=(0, 1))
    differentiable.defvjp(
        lambda linearise, count, heights: (forward(linearise, count, heights), heights),
        lambda linearise, _, heights, derivatives: (backward(linearise, heights, derivatives),),
    )
    return differentiable
