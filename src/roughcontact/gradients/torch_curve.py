"""A differentiable curve as a function that PyTorch records."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from roughcontact.arrays import as_like, on_host
from roughcontact.errors import about
from roughcontact.gradients.linearised import no_second_derivative

__all__ = ["torch_values"]


def torch_values(linearise: Callable[[Any], Any], heights: Any) -> tuple[Any, ...]:
    """Return the values of a linearised function of heights as tensors that remember it for the backward pass."""
    if heights.device.type == "meta":
        raise about("heights", "on PyTorch's device 'meta' hold no values", "create them on another device")
    return _recorded()(linearise, heights)[:-1]  # type: ignore[no-any-return]


@cache
def _recorded() -> Any:
    """Return the recorded function; PyTorch is imported at its first use."""
    import torch

    def each(size: int, axes: tuple[Any, ...], given: tuple[Any, ...]) -> list[list[Any]]:
        """Return the arguments of each member of a batch."""
        return [
            [
                one[i] if isinstance(one, list) else one if axis is None else one.select(axis, i)
                for axis, one in zip(axes, given, strict=True)
            ]
            for i in range(size)
        ]

    class Pullback(torch.autograd.Function):  # type: ignore[misc]
        @staticmethod
        def forward(pullback: Any, heights: Any, *derivatives: Any) -> Any:
            return as_like(pullback(*map(on_host, derivatives)), heights)

        @staticmethod
        def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
            pass

        @staticmethod
        def backward(ctx: Any, *_: Any) -> None:
            raise no_second_derivative()

        @staticmethod
        def vmap(info: Any, axes: Any, *given: Any) -> Any:
            return torch.stack([Pullback.apply(*one) for one in each(info.batch_size, axes, given)]), 0

    class Values(torch.autograd.Function):  # type: ignore[misc]
        @staticmethod
        def forward(linearise: Any, heights: Any) -> tuple[Any, ...]:
            values, pullback = linearise(on_host(heights.detach()))
            return (*(as_like(value, heights) for value in values), pullback)

        @staticmethod
        def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
            ctx.save_for_backward(inputs[1])
            ctx.pullback = output[-1]

        @staticmethod
        def backward(ctx: Any, *derivatives: Any) -> tuple[None, Any]:
            return None, Pullback.apply(ctx.pullback, *ctx.saved_tensors, *derivatives[:-1])

        @staticmethod
        def vmap(info: Any, axes: Any, *given: Any) -> Any:
            rows = zip(*(Values.apply(*one) for one in each(info.batch_size, axes, given)), strict=True)
            *values, pullbacks = rows
            return (*map(torch.stack, values), list(pullbacks)), (*(0 for _ in values), None)

    return torch.compiler.disable(Values.apply)
