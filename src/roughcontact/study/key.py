"""What names a case in a store, and what its randomness is made of."""

from __future__ import annotations

import hashlib
import json
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from roughcontact.study.case import Case, Parameters

__all__ = ["canonical", "generator", "key_of"]


def canonical(parameters: Parameters) -> str:
    """Return parameters as JSON that is the same for equal ones: names sorted, no blanks, every digit of a number."""
    return json.dumps(
        parameters.model_dump(mode="json"), sort_keys=True, separators=(",", ":"), allow_nan=False
    )


def key_of(case: Case, parameters: str, *, seed: int, sample: int) -> str:
    """Return the key of one sample of a case with `canonical` parameters: 64 hexadecimal digits."""
    text = json.dumps([case.name, case.version, seed, sample], separators=(",", ":")) + parameters
    return hashlib.sha256(text.encode()).hexdigest()


def generator(seed: int, sample: int) -> np.random.Generator:
    """Return the generator of a sample: of the seed of the study and its number alone, so that samples are paired."""
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(sample,)))
