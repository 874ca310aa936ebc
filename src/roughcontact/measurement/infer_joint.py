"""The topography of a joint, inferred from its measured stiffness."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.measurement.importance import Posterior, Prior, posterior
from roughcontact.measurement.joint_data import JointData
from roughcontact.measurement.joint_emulator import SOFTEST, joint_emulator
from roughcontact.measurement.joint_explanations import JointExplanation, explanations
from roughcontact.measurement.joint_inference import SHARES, InferredParameter, JointInference
from roughcontact.measurement.joint_model import DISCREPANCY, DRAWN, UNLIKELY, JointModel
from roughcontact.measurement.joint_topography import PARAMETERS, JointTopography, prior_of
from roughcontact.validation import Array, RngLike, as_generator, numeric, positive, shown

__all__ = ["infer_joint"]

EDGE = 0.05  # in ln p: nearer to an end of the emulator, a joint counts as beyond it
AT_EDGE = 0.05  # probability of such joints that is refused
EXPLAINED = 500  # joints of the topography that explanations are compared with
_UNITS = {"rms": "m", "rolloff": "m", "hurst": "", "band": "", "modulus": "Pa", "hardness": "Pa"}


@numeric(modulus="Pa", area="m^2", hardness="Pa")
def infer_joint(
    data: JointData,
    *,
    modulus: float,
    modulus_error: float,
    area: float,
    branch: Literal["loading", "unloading"],
    profile: JointTopography | None = None,
    hardness: float | None = None,
    hardness_error: float | None = None,
    rng: RngLike = 0,
) -> JointInference:
    """Return the effective height of a joint, inferred from its stiffness.

    The stiffness of a large joint depends on its rms height h and its roll-off wavelength l only through an effective
    height ``h^a l^(1 - a)``, where a is the exponent of the stiffness, about 0.9. This height is inferred. About Hurst
    exponent, h and l separately the stiffness holds little information: ``JointInference.parameters`` states how much.

    The model: a joint whose faces together are Gaussian, with waves from l down to l/4 to l/8, as computed ensembles
    have them, and a discrepancy of 5 %. It is elastic, or on first loading flows at a given hardness.

    Parameters
    ----------
    data : JointStiffness or JointClosures
        The measurement.
    modulus, modulus_error : float
        Reduced modulus E* [Pa] and its relative standard deviation.
    area : float
        Nominal area of the joint [m^2].
    branch : {"loading", "unloading"}
        The branch that was measured. On unloading the height is that of the faces as they were flattened.
    profile : JointTopography, optional
        The measured topography. The answer then states whether this is the joint of that topography, and if not,
        whether a waviness or a hardness would make it so.
    hardness : float, optional
        Hardness of the softer face [Pa], for a first loading; by default the joint is elastic. At most half of it may
        flow.
    hardness_error : float, optional
        Relative standard deviation of the hardness.
    rng : int or Generator
        Source of the draws of the posterior.

    Returns
    -------
    JointInference

    Raises
    ------
    ValueError
        If the branch is not named, a value is not positive, the joint is smaller than 64 squares of the roll-off
        wavelength, the pressures are outside the emulator, or a hardness is given without error or on unloading.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> p = np.array([7e6, 15e6, 30e6, 65e6, 140e6])
    >>> data = rc.JointStiffness(p, 1.9e7 * p**0.88, errors=0.05, gain=0.03)
    >>> found = rc.infer_joint(data, modulus=115e9, modulus_error=0.02, area=2.5e-6, branch="loading")
    >>> low, high = found.interval(0.9)
    >>> f"{found.effective_height * 1e6:.1f} um, {low * 1e6:.1f} to {high * 1e6:.1f}; K ~ p^{found.exponent:.2f}"
    '1.8 um, 1.6 to 2.0; K ~ p^0.90'
    """
    if branch not in ("loading", "unloading"):
        raise about(
            "branch",
            f"must be 'loading' or 'unloading', not {shown(branch)}",
            "name the one that was measured",
        )
    for name, value in (("modulus", modulus), ("modulus_error", modulus_error), ("area", area)):
        positive(value, name)
    soft = _hardness(hardness, hardness_error, branch)
    prior = prior_of((modulus, modulus_error), area, profile, soft)
    model = JointModel(joint_emulator(), area)
    size = prior.mean.size
    before = prior.draw(np.random.default_rng(0).random((DRAWN, size)))
    _require_inside(model, before, np.full(DRAWN, 1 / DRAWN), data.log_pressures, 1 - 1 / DRAWN)
    found = posterior(prior, lambda points: model.log_likelihood(points, data), as_generator(rng))
    exponent = float(found.weights @ model.exponent(found.points, float(data.log_pressures.mean())))
    chance, departs = model.p_value(data, None if profile is None else prior, found)
    fits = not chance < UNLIKELY
    if fits:  # a curve of another shape may end there, too
        _require_inside(model, found.points, found.weights, data.log_pressures, AT_EDGE)
    reasons: tuple[JointExplanation, ...] = ()
    if not fits and profile is not None:
        flows = soft is None and branch == "loading"
        reasons = explanations(model, data, before[:EXPLAINED], flows)
    faces = "Gaussian faces that flow" if soft else "elastic, Gaussian faces"
    skewed = "with a skewness of +1 the height is 1.6 times the true one, with -1 0.6 times"
    notes = [Note(Rank.LIMITED, f"{faces} ({skewed}); a discrepancy of {DISCREPANCY:.0%} is assumed")]
    if branch == "unloading":
        notes.append(
            Note(Rank.LIMITED, "on unloading the height is that of the faces as they were flattened")
        )
    if not fits:
        notes.append(Note(Rank.WRONG, _why_not(departs, profile, reasons)))
    parameters = _parameters(prior, found) if fits and data.measured.size > 1 else ()
    return JointInference(exponent, chance, departs, parameters, reasons, data, in_order(notes), model, found)


def _hardness(hardness: float | None, error: float | None, branch: str) -> tuple[float, float] | None:
    """Return hardness and error, if given."""
    if hardness is None and error is None:
        return None
    if hardness is None or error is None:
        raise InputError(
            "hardness and hardness_error belong together",
            "give both, such as hardness=2e9, hardness_error=0.1",
            "hardness" if hardness is None else "hardness_error",
        )
    if branch != "loading":
        raise InputError("faces flow on first loading only", "leave out the hardness", "hardness")
    return float(positive(hardness, "hardness")), float(positive(error, "hardness_error"))


def _why_not(departs: str, profile: JointTopography | None, reasons: tuple[JointExplanation, ...]) -> str:
    """Return what the measurement contradicts, and what would explain it."""
    found = ", or by ".join(map(str, reasons))
    if departs == "level" and profile is not None:
        what = "not the joint of this topography: its stiffness departs from that of all such joints"
        otherwise = ", and no waviness or hardness explains it"
    else:
        what = f"not this model: the {departs} of the stiffness departs from that of all joints"
        otherwise = ". Bodies or a machine in series, flow, waviness of few waves or mated faces change it"
    return what + (f". It could be explained by {found}" if found else otherwise)


def _require_inside(model: JointModel, points: Array, weights: Array, log_p: Array, most: float) -> None:
    """Refuse pressures beyond the emulator, or nearly so, for more than a share of the draws."""
    if float(weights @ (model.margin(points, log_p) < EDGE)) > most:
        low, high = np.exp(model.emulator.nodes[[0, -1]])
        first, last = np.exp(np.median(model.place(points, log_p), axis=0)[[0, -1]])
        if points.shape[1] > 5 and low <= first and last <= high:
            largest, hardness = math.exp(log_p[-1]), float(np.exp(np.median(points[:, 5])))
            raise InputError(
                f"joints that flow are computed for a hardness from {SOFTEST:g} E* h/l on and up to pressures of half "
                f"of it, and such a joint has a hardness of {hardness / largest * last:.2g} E* h/l, "
                f"{hardness / largest:.2g} times the largest pressure",
                "leave out the largest pressures, or press a map with this hardness: rc.loading_curve",
                "pressures",
            )
        raise InputError(
            f"the pressures lie beyond the emulator, which holds p l/(E* h) from {low:.2g} to {high:.2g}, and such a "
            f"joint has about {first:.2g} to {last:.2g}",
            "leave out the smallest or the largest pressures, or press a map: rc.loading_curve",
            "pressures",
        )


def _parameters(prior: Prior, found: Posterior) -> tuple[InferredParameter, ...]:
    size = prior.mean.size
    before = prior.draw(np.tile(np.array(SHARES)[:, None], (1, size)))
    nats = found.nats(prior)
    rows = []
    for j, name in enumerate(PARAMETERS[:size]):
        ends = np.stack([before[:, j], found.quantiles(found.points[:, j], np.array(SHARES))])
        first, then = ends if name == "hurst" else np.exp(ends)
        rows.append(InferredParameter(name, _UNITS[name], _three(first), _three(then), float(nats[j])))
    return tuple(rows)


def _three(values: Array) -> tuple[float, float, float]:
    low, middle, high = map(float, values)
    return low, middle, high
