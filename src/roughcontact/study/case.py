"""A case: what one sample of a study computes, as a pure function of its parameters and a random generator."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import BaseModel, ConfigDict

if TYPE_CHECKING:
    import xarray

__all__ = ["Case", "Parameters"]


class Parameters(BaseModel):
    """What a case may be told: a model whose fields have types and limits; unknown names are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


@dataclass(frozen=True, slots=True)
class Case:
    """A computation that a study repeats.

    Parameters
    ----------
    name : str
        What it is called in study files and in the database.
    version : int
        To be raised whenever the same parameters give another answer than before: it is part of every key.
    parameters : type of Parameters
        Model of what it takes.
    run : function
        ``run(parameters, rng) -> xarray.Dataset``. Pure: the same parameters and generator give the same record bit
        for bit. The record holds scalars and short arrays with their dimensions, ``units`` and ``long_name``; all
        samples of a study are laid side by side along these dimensions. A variable ``residual`` is taken as the
        certificate of the case (its largest value).
    fields : tuple of str
        Variables of the record that are large: kept in a NetCDF file of their own, beside the database.
    """

    name: str
    version: int
    parameters: type[Parameters]
    run: Callable[[Any, np.random.Generator], xarray.Dataset]
    fields: tuple[str, ...] = ()
