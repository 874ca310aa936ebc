"""A loading curve as a differentiable function of the heights."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Generic, NamedTuple, TypeAlias, TypeVar

import numpy as np
from array_api_compat import is_jax_array, is_torch_array

from roughcontact.arrays import on_host
from roughcontact.contact.convergence import ConvergenceError
from roughcontact.contact.loading import solutions_along
from roughcontact.contact.problem import Body
from roughcontact.contact.size_law import Hardness
from roughcontact.contact.solution import Solution
from roughcontact.errors import about
from roughcontact.gradients.derivatives import Reference, Sensitivity, require_reference
from roughcontact.gradients.sensitivity import sensitivity
from roughcontact.grid import AnyGrid, Grid
from roughcontact.halfspace.operators.build import body_on
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.labels.variables import force_unit
from roughcontact.materials import Modulus
from roughcontact.solver.control import checked_tolerance
from roughcontact.solver.loads import Loads
from roughcontact.surface.radial import RadialProfile
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, number, numeric, shown

__all__ = ["CurveValues", "DifferentiableCurve", "differentiable_curve"]

A = TypeVar("A")
Weights: TypeAlias = float | Sequence[float] | Array
"""Derivatives of a scalar with respect to one quantity of each load."""


class CurveValues(NamedTuple, Generic[A]):
    """What a `DifferentiableCurve` returns for heights: one value for each load, arrays of shape (n,).

    They are of the library of the heights.

    Attributes
    ----------
    force : array
        Force [N].
    depth : array
        Depth from the reference [m].
    mean_gap : array
        Mean gap [m].
    energy : array
        Elastic energy [J].

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> values, _ = rc.differentiable_curve(ball.grid, 1e9, forces=[1e-3, 2e-3]).linearise(ball.heights)
    >>> values._fields, values.mean_gap.shape
    (('force', 'depth', 'mean_gap', 'energy'), (2,))
    """

    force: A
    depth: A
    mean_gap: A
    energy: A


@dataclass(frozen=True, eq=False)
class DifferentiableCurve:
    """The loads of `differentiable_curve`, as a function of heights.

    Attributes
    ----------
    grid : Grid or RadialGrid
    modulus : float, Solid, Material, str, or a pair of bodies
    loads : Loads
    reference : {"first touch", "level"}
    operator : Operator, optional
    tolerance : float
    hardness : float, array or Material, optional

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((33, 33), 1e-6)
    >>> curve = rc.DifferentiableCurve(grid, 1e9, rc.differentiable_curve(grid, 1e9, forces=[1e-3]).loads)
    >>> curve.linearise(rc.shapes.paraboloid(grid, radius=1e-4).heights)[0].force
    array([0.001])
    """

    grid: AnyGrid
    modulus: Modulus
    loads: Loads
    reference: Reference = "first touch"
    operator: Operator | None = None
    tolerance: float = 1e-8
    hardness: Hardness | None = None

    def __call__(self, heights: A) -> CurveValues[A]:
        """Return the curve of heights, which PyTorch and JAX can differentiate.

        PyTorch and JAX record the call for reverse-mode differentiation (``backward``, ``jax.grad``), in JAX also under
        ``jax.jit``. Forward mode (``torch.func.jvp``, ``jax.jvp``) is not supported; both libraries raise an error. The
        curve is computed on the host: heights on a GPU are copied there, and the values are copied back. Batches of
        ``vmap`` are computed one after the other.

        Parameters
        ----------
        heights : array, shape of the grid
            Heights [m] of NumPy, PyTorch or JAX, in double precision; NaN where nothing was measured.

        Returns
        -------
        CurveValues
            Arrays of the same library, of shape (n,).

        Raises
        ------
        ValueError
            If the heights do not fit the grid, are neither float64 nor float32, hold no values (PyTorch's device
            ``meta``), or a load has no derivatives, see `sensitivity`. Also if a second derivative is requested.
        ConvergenceError
            If a load missed its tolerance. Errors that depend on the values of the heights reach users of JAX as errors
            of its runtime.

        Warns
        -----
        UserWarning
            If heights of PyTorch or JAX are in single precision.

        Examples
        --------
        >>> import roughcontact as rc
        >>> curve = rc.differentiable_curve(rc.Grid((33, 33), 1e-6), 1e9, forces=[1e-3])
        >>> f"{curve(rc.shapes.paraboloid(curve.grid, radius=1e-4).heights).depth[0] * 1e9:.0f} nm"
        '177 nm'
        """
        given: Any = heights
        if not (is_torch_array(given) or is_jax_array(given)):
            values: Any = self.linearise(given)[0]
            return values  # type: ignore[no-any-return]
        self._require_recordable(given)
        if is_torch_array(given):
            from roughcontact.gradients.torch_curve import torch_values

            return CurveValues(*torch_values(self.linearise, given))
        from roughcontact.gradients.jax_curve import jax_values

        return CurveValues(*jax_values(self.linearise, len(self.loads.values), given))

    def linearise(self, heights: Array) -> tuple[CurveValues[Array], Callable[..., Array]]:
        """Return the curve of heights, and the function that takes derivatives with respect to it back to the heights.

        Parameters
        ----------
        heights : array, shape of the grid
            Heights [m]; NaN where nothing was measured. Arrays of other libraries are copied to the host.

        Returns
        -------
        values : CurveValues
        pullback : function
            It takes the derivatives of a scalar with respect to `force`, `depth`, `mean_gap` and `energy`, by these
            names or in this order, each of shape (n,), and returns those with respect to the heights. Given loads do
            not depend on the heights, so derivatives with respect to them do not count.

        Raises
        ------
        ValueError
            If the heights do not fit the grid, no cell touches at a depth from a level, or a load has no derivatives,
            see `sensitivity`.
        ConvergenceError
            If a load missed its tolerance.

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> grid = rc.Grid((16, 16), 1e-6, periodic=True)
        >>> heights = np.random.default_rng(1).normal(scale=1e-7, size=grid.shape)
        >>> curve = rc.differentiable_curve(grid, 1e9, pressures=[1e6, 2e6], reference="level")
        >>> values, pullback = curve.linearise(heights)
        >>> target = values.depth + 1e-8
        >>> gradient = pullback(depth=values.depth - target)  # of half the sum of the squared differences
        >>> gradient.shape
        (16, 16)
        """
        body = self._body(heights)
        level = float(np.nanmax(body.heights)) if self.reference == "level" else 0.0
        loads = self._since_first_touch(level)
        path = solutions_along(body, self.modulus, loads, self.operator, None, self.tolerance, self.hardness)
        states = [self._derivatives(solution) for solution in path]
        values = CurveValues(
            *(
                np.array([getattr(state.solution, name) for state in states])
                for name in ("force", "depth", "mean_gap", "elastic_energy")
            )
        )

        def pullback(
            force: Weights = 0.0,
            depth: Weights = 0.0,
            mean_gap: Weights = 0.0,
            energy: Weights = 0.0,
        ) -> Array:
            total = np.zeros(self.grid.shape)
            for name, given in zip(CurveValues._fields, (force, depth, mean_gap, energy), strict=True):
                weights = self._fitting(given, name)
                for state, weight in zip(states, weights, strict=True):
                    if weight and name != self._held:
                        total += weight * getattr(state, f"{name}_at_{self._held}")
            return total

        return values._replace(depth=values.depth - level), pullback

    @property
    def _of_depths(self) -> bool:
        return self.loads.kind == "depth"

    @property
    def _held(self) -> str:
        return "depth" if self._of_depths else "force"

    def _since_first_touch(self, level: float) -> Loads:
        if not (self._of_depths and self.reference == "level"):
            return self.loads
        depths = self.loads.values + level
        if not depths[0] > 0:
            raise about(
                "depths",
                f"count from the level: at {self.loads.values[0]:g} m no cell touches",
                f"give more than {-level:g} m",
            )
        return Loads("depth", depths)

    def _fitting(self, given: Weights, name: str) -> Array:
        weights = number(given, f"the derivative with respect to {name}")
        if weights.shape not in ((), self.loads.values.shape):
            raise about(name, f"has the shape {weights.shape}, the loads {self.loads.values.shape}")
        return np.broadcast_to(weights, self.loads.values.shape)

    def _derivatives(self, solution: Solution) -> Sensitivity:
        if not solution.status.converged:
            raise ConvergenceError(solution)
        return sensitivity(solution, reference=self.reference)

    def _require_recordable(self, heights: Any) -> None:
        """Refuse heights of PyTorch or JAX that cannot be differentiated, and warn of single precision."""
        self._require_shape(tuple(heights.shape))
        precision = str(heights.dtype).removeprefix("torch.")
        if precision not in ("float32", "float64"):
            raise about("heights", f"must be of type float64, not {precision}", "convert them to float64")
        if precision == "float32":
            warnings.warn(
                "heights in single precision hold about 7 digits of the largest height, and depths and derivatives "
                "are rounded to 7 digits; use float64, in JAX after jax.config.update('jax_enable_x64', True)",
                stacklevel=3,
            )

    def _require_shape(self, shape: tuple[int, ...]) -> None:
        if shape != self.grid.shape:
            raise about("the heights", f"have the shape {shape}, the grid {self.grid.shape}")

    def _body(self, heights: Array) -> Body:
        self._require_shape(np.shape(heights))
        if not isinstance(self.grid, Grid):
            return RadialProfile(heights, self.grid)
        surface = Surface(heights, self.grid)
        return replace(surface, heights=on_host(surface.heights))


@numeric(modulus="Pa", forces=force_unit, depths="m", pressures="Pa", hardness="Pa")
def differentiable_curve(
    grid: AnyGrid,
    modulus: Modulus,
    *,
    forces: Sequence[float] | Array | None = None,
    depths: Sequence[float] | Array | None = None,
    pressures: Sequence[float] | Array | None = None,
    reference: Reference = "first touch",
    operator: Operator | None = None,
    tolerance: float = 1e-8,
    hardness: Hardness | None = None,
) -> DifferentiableCurve:
    """Return the loading curve of a grid as a function of the heights that can be differentiated.

    Parameters
    ----------
    grid : Grid or RadialGrid
        Of the heights.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    forces, depths, pressures : array, shape (n,)
        Exactly one: strictly increasing forces [N], depths from the reference [m], or nominal pressures [Pa].
    reference : {"first touch", "level"}
        Where the depth counts from: first touch, or the zero of the heights, which does not move with the highest cell.
    operator : Operator, optional
        A body other than the half-space on the grid, see `press`.
    tolerance : float
        Largest residual of each load.
    hardness : float, array or Material, optional
        Pressure that no cell exceeds [Pa], see `press`.

    Returns
    -------
    DifferentiableCurve

    Raises
    ------
    ValueError
        If not exactly one kind of loads is given, they do not increase, or another argument is out of range.

    Examples
    --------
    >>> import roughcontact as rc
    >>> curve = rc.differentiable_curve(rc.Grid((33, 33), 1e-6), 1e9, forces=[1e-3])
    >>> values, pullback = curve.linearise(rc.shapes.paraboloid(curve.grid, radius=1e-4).heights)
    >>> f"{values.depth[0] * 1e9:.0f} nm"
    '177 nm'
    """
    if not isinstance(grid, AnyGrid):
        raise about("the grid", f"must be a Grid or a RadialGrid, not {shown(grid)}")
    require_reference(reference)
    loads = Loads.of(forces=forces, depths=depths, pressures=pressures).rising(
        "give the loads in order, each once"
    )
    body = body_on(grid, modulus, operator)  # once for all heights
    return DifferentiableCurve(grid, modulus, loads, reference, body, checked_tolerance(tolerance), hardness)
