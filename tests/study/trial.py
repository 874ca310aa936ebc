"""Cases that are quick, and fail as they are told to."""

import sys
import time
from typing import Literal

import numpy as np
import xarray
from pydantic import Field

from roughcontact.study.case import Case, Length, Parameters, Positive

NAME = "study.trial:CASE"


class Trial(Parameters):
    hurst: float = Field(ge=-1, le=3)
    size: Positive[Length] = 1e-3
    points: int = Field(default=4, ge=1)
    end: Literal["well", "error", "exit", "dictionary", "object", "no field"] = "well"
    seconds: float = 0.0
    label: str | None = None


def wait(seconds):
    time.sleep(seconds)


def fail(parameters):
    raise ArithmeticError(f"no contact at {parameters.hurst}")


def run(parameters, rng):
    wait(parameters.seconds)
    if parameters.end == "error":
        fail(parameters)
    if parameters.end == "exit":
        sys.exit(3)
    if parameters.end == "dictionary":
        return {"force": 1.0}
    force = rng.lognormal(size=parameters.points) * parameters.size
    record = xarray.Dataset(
        {
            "force": ("load", force, {"units": "N"}),
            "stiffness": ("load", force**parameters.hurst),
            "residual": ("load", force * 1e-9),
            "word": ("axis", ["y", "x"]),
        },
        {"load": np.arange(parameters.points)},
    )
    if parameters.end == "object":
        record["force"] = ("load", np.full(parameters.points, None))
    return record


def run_with_fields(parameters, rng):
    record = run(parameters, rng)
    if parameters.end != "no field":
        record["pressure"] = (("y", "x"), rng.normal(size=(50, 70)), {"units": "Pa"})
        record.coords["x"] = np.arange(70.0)
    return record


CASE = Case("trial", 1, Trial, run)
SAME = CASE
NEWER = Case("trial", 2, Trial, run)
WITH_FIELDS = Case("trial with fields", 1, Trial, run_with_fields, fields=("pressure",))
NO_CASE = run
