"""What the measured stiffness of a joint tells of its topography."""

from __future__ import annotations

from typing import Literal

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.measurement.importance import Posterior, Prior, posterior
from roughcontact.measurement.joint_emulator import joint_emulator
from roughcontact.measurement.joint_inference import SHARES, InferredParameter, JointInference
from roughcontact.measurement.joint_model import DISCREPANCY, JointModel
from roughcontact.measurement.joint_topography import PARAMETERS, JointTopography, prior_of
from roughcontact.validation import Array, RngLike, as_generator, numeric, positive

__all__ = ["infer_joint"]

AT_EDGE, EDGE = (
    0.05,
    0.05,
)  # probability within this distance in ln p from the ends of the emulator, which is refused
_UNITS = {"rms": "m", "rolloff": "m", "hurst": "", "band": "", "modulus": "Pa"}


@numeric(pressures="Pa", stiffness="Pa/m", modulus="Pa", area="m^2")
def infer_joint(
    pressures: float | Array,
    stiffness: float | Array,
    *,
    errors: float | Array | None = None,
    modulus: float,
    modulus_error: float,
    area: float,
    branch: Literal["loading", "unloading"] | None = None,
    gain: float = 0.0,
    profile: JointTopography | None = None,
    rng: RngLike = 0,
) -> JointInference:
    """Return what the stiffness of a joint tells of its topography.

    The stiffness of a large joint depends on its rms height h and its roll-off wavelength l through an effective height
    ``h^a l^(1 - a)`` alone, where a is the exponent of the stiffness, about 0.9. This height is inferred. Of Hurst
    exponent, h and l apart the stiffness tells little: `JointInference.parameters` states how much.

    The model: an elastic joint whose faces together are Gaussian, with waves from l down to l/4 to l/8, as
    `joint_emulator` holds them, and a discrepancy of 5 %.

    Parameters
    ----------
    pressures : float or array, shape (n,)
        Nominal pressures [Pa].
    stiffness : float or array, shape (n,)
        Interfacial stiffness per area K/A0 [Pa/m], without the compliance of the bodies.
    errors : float or array, shape (n,)
        Relative standard deviations of the stiffnesses, independent of each other.
    modulus, modulus_error : float
        Reduced modulus E* [Pa] and its relative standard deviation.
    area : float
        Nominal area of the joint [m^2].
    branch : {"loading", "unloading"}
        The branch that was measured. On unloading the height is that of the faces as they were flattened.
    gain : float
        Relative standard deviation of an error that all stiffnesses share, such as that of a calibration.
    profile : JointTopography, optional
        The measured topography. The answer then states whether this is the joint of that topography.
    rng : int or Generator
        Source of the draws of the posterior.

    Returns
    -------
    JointInference

    Raises
    ------
    ValueError
        If `errors` or `branch` is missing, a value is not positive, the joint is smaller than 64 squares of the
        roll-off wavelength, or the pressures are outside the emulator.
    """
    if branch not in ("loading", "unloading"):
        raise about(
            "branch", f"must be 'loading' or 'unloading', not {branch!r}", "give the branch that was measured"
        )
    if errors is None:
        raise InputError(
            "errors are missing", "give the relative standard deviation of each stiffness", "errors"
        )
    p, k, sd = np.broadcast_arrays(
        np.atleast_1d(positive(pressures, "pressures")),
        np.atleast_1d(positive(stiffness, "stiffness")),
        np.atleast_1d(positive(errors, "errors")),
    )
    for name, value in (("modulus", modulus), ("modulus_error", modulus_error), ("area", area)):
        positive(value, name)
    positive(gain, "gain", zero=True)
    prior = prior_of(modulus, modulus_error, area, profile)
    model = JointModel(joint_emulator(), area)
    log_p, log_k = np.log(p), np.log(k)
    noise = np.diag(sd**2) + gain**2
    found = posterior(
        prior, lambda points: model.log_likelihood(points, log_p, log_k, noise), as_generator(rng)
    )
    _require_inside(model, found, log_p)
    exponent = float(found.weights @ model.exponent(found.points, float(log_p.mean())))
    known = profile is not None
    chance, departs = np.nan, ""
    if p.size > 1 or known:
        chance, departs = model.p_value(prior if known else None, found, log_p, log_k, noise)
    fits = not chance < 0.01
    parameters = _parameters(prior, found) if fits and p.size > 1 else ()
    notes = [Note(Rank.LIMITED, f"elastic, Gaussian faces; a discrepancy of {DISCREPANCY:.0%} is assumed")]
    if branch == "unloading":
        notes.append(
            Note(Rank.LIMITED, "on unloading the height is that of the faces as they were flattened")
        )
    if not fits:
        notes.append(Note(Rank.WRONG, _why_not(departs)))
    return JointInference(
        exponent,
        float(chance),
        departs,
        parameters,
        p.copy(),
        k.copy(),
        sd.copy(),
        in_order(notes),
        model,
        found,
    )


def _why_not(departs: str) -> str:
    if departs == "level":
        return (
            "this is not the joint of the topography: its stiffness departs from that of all such joints. Waviness "
            "beyond the measured waves makes a joint softer"
        )
    return (
        f"not this model: the {departs} of the stiffness departs from that of all joints. Bodies or a machine in "
        "series, flow, waviness of few waves or mated faces change it"
    )


def _require_inside(model: JointModel, found: Posterior, log_p: Array) -> None:
    place = model.place(found.points, log_p)
    low, high = model.emulator.nodes[[0, -1]]
    near = (place.min(axis=1) < low + EDGE) | (place.max(axis=1) > high - EDGE)
    if float(found.weights @ near) > AT_EDGE:
        raise InputError(
            f"the pressures lie beyond the emulator, which holds p l/(E* h) from {np.exp(low):.2g} to "
            f"{np.exp(high):.2g}, and this joint has {np.exp(place.min()):.2g} to {np.exp(place.max()):.2g}",
            "leave out the smallest or the largest pressures, or press a map: rc.loading_curve",
            "pressures",
        )


def _parameters(prior: Prior, found: Posterior) -> tuple[InferredParameter, ...]:
    before = prior.draw(np.tile(np.array(SHARES)[:, None], (1, len(PARAMETERS))))
    nats = found.nats(prior)
    rows = []
    for j, name in enumerate(PARAMETERS):
        ends = np.stack([before[:, j], found.quantiles(found.points[:, j], np.array(SHARES))])
        first, then = ends if name == "hurst" else np.exp(ends)
        rows.append(InferredParameter(name, _UNITS[name], _three(first), _three(then), float(nats[j])))
    return tuple(rows)


def _three(values: Array) -> tuple[float, float, float]:
    low, middle, high = map(float, values)
    return low, middle, high
