"""Every function of numbers in the theories, each of its arguments spoilt in turn: a ValueError that names it."""

import functools
import inspect

import numpy as np
import pint
import pytest

import roughcontact as rc
from roughcontact.theory.asperity_models import (
    asperities,
    bush_gibson_thomas,
    greenwood_williamson,
    interaction,
)
from roughcontact.theory.joints import (
    cattaneo,
    conductance,
    holm,
    jaeger,
    leakage,
    mindlin,
    thermal,
    ultrasound,
)
from roughcontact.theory.persson_theory import persson, persson_friction, persson_plastic, persson_separation
from roughcontact.theory.plastic_asperities import (
    chang_etsion_bogy,
    kogut_etsion,
    plasticity,
    pullen_williamson,
)
from roughcontact.theory.random_surfaces import nayak, partial_moments, waves
from roughcontact.theory.spheres_and_punches import hertz, power_law_indenter, punch, rough_sphere
from roughcontact.theory.springs import (
    beat_wave,
    cosine,
    gaussian_heights,
    height_distribution,
    stepped,
    two_cosines,
)
from roughcontact.theory.stiffness_laws import finite_size, pohrt_popov, rough_square

ROUGH = rc.Moments(1e-14, 1e-2, 1e12)
SPHERE = hertz.law(1e-2, 1e9)
CELL = finite_size.Cell(0.8, 1e-7, 1e-3)
MILLIMETRE = pint.get_application_registry().Quantity(1.0, "mm")
# Good values by the names of parameters, and where a name means something else in one place.
GOOD = {
    **{
        "modulus": 1e9,
        "length": 1e-3,
        "spacing": 1e-5,
        "stiffness": 1e3,
        "area": 1e-6,
        "force": 1e-2,
        "depth": 1e-8,
    },
    **{
        "radius": 1e-3,
        "rms": 1e-7,
        "hurst": 0.8,
        "amplitude": 1e-7,
        "separation": 2e-7,
        "pressure": 1e5,
        "ratio": 0.8,
    },
    **{
        "friction": 0.3,
        "tangential": 1e-3,
        "distance": 1e-5,
        "conductance": 1e2,
        "level": 2.0,
        "stress": 1e6,
        "cut": "interior",
    },
    **{
        "moments": ROUGH,
        "surface": ROUGH,
        "fraction": 0.1,
        "hardness": 1e9,
        "exponent": 2.0,
        "coefficient": 1e2,
    },
    **{
        "spectrum": waves.Waves.of_bands(np.array([1e5, 2e5, 4e5]), np.array([1e-16, 1e-16, 1e-17])),
        "cell": CELL,
    },
    **{
        "resistivities": (1e-8, 2e-8),
        "conductivities": (10.0, 20.0),
        "mechanical": SPHERE,
        "loading": SPHERE,
    },
    **{
        "theta": 1.0,
        "poisson_ratio": 0.3,
        "constant": 1.0,
        "outer_radius": 2e-3,
        "inner_radius": 1e-3,
        "side": 1e-3,
    },
    **{"half_width": 1e-4, "reference_length": 1e-2, "position": 1e-5, "semi_axes": (1e-4, 2e-4), "x": 1e-5},
    **{
        "y": 1e-5,
        "count": 3,
        "alpha": 2.0,
        "local": 2e3,
        "cell_radius": 1e-2,
        "long_wave": (1e-6, 1e4),
        "modes": 2,
    },
    **{
        "radii": np.array([1e-5, 2e-5]),
        "positions": np.array([[0.0, 0.0], [1e-3, 0.0]]),
        "short_amplitude": 1e-8,
    },
    **{"height": 1e-6, "wavenumber": 1e4, "stiffness_exponent": 0.5, "density_exponent": 1.0, "order": 1.5},
    **{
        "curvature": 1.0,
        "mean": 1.0,
        "deviator": 0.5,
        "first": rc.Solid(1e11, 0.3),
        "plane": 1.0,
        "law": SPHERE,
    },
    **{"decay": 1e-7, "turned": 2e-3},
    **{"material": rc.viscoelastic.standard_solid(1e6, 1e8, 1e-3), "speed": 0.01},
    **{"frequency": 1e6, "impedances": (4e7, 2e7), "reflected": 0.6, "density": 7850.0, "slope": 1e6},
}
OTHERS = {
    "hertz.point": {"modulus": 1e9, "radius": 1e-3, "force": 1e-2},
    "hertz.line": {"modulus": 1e9, "radius": 1e-3, "force": 1e2},
    "hertz.elliptic": {"modulus": 1e9, "radii": (1e-3, 2e-3), "force": 1e-2},
    "power_law_indenter.contact": {"modulus": 1e9, "coefficient": 1e2, "force": 1e-2},
    **{
        f"rough_square.{one}": {"force": 5e-3} for one in ("stiffness", "relative_error", "single_range")
    },  # in window
    "rough_square.squares_needed": {"error": 0.1},
    "conductance.law": {"resistivities": (1e-8, 2e-8)},
    "interaction.finite_body": {"law": greenwood_williamson.law(ROUGH, 1e9, 1e-6)},
    "punch.two_discs": {"spacing": 5e-3},
    "plasticity.summit_index": {"height": np.array([1e-6, 2e-6]), "curvature": np.array([1e4, 2e4])},
    "pullen_williamson.flattened": {"heights": np.array([1e-6, 2e-6])},
    "leakage.bruggeman": {"conductances": np.array([1.0, 2.0]), "threshold": 0.5},
    "leakage.critical_constriction": {"pressure": 1e6, "threshold": 0.4},
    "thermal.constriction": {"ratio": 0.3},
    "ultrasound.combined": {"stiffness": np.array([1e14, 1.01e14]), "error": np.array([1e12, 1e12])},
    "ultrasound.second_harmonic": {"stiffness": 1e14, "amplitude": 1e-9},
    "Asperity": {"exponent": 1.5},
    "SteppedIndenter": {"ratio": 2.0},
    "Hierarchy": {"ratio": 3.0},
    "SlippingSphere.cycle_loss": {"amplitude": 1e-3},
}
MODULES = {
    "beat_wave": beat_wave, "bush_gibson_thomas": bush_gibson_thomas, "conductance": conductance,
    "cosine": cosine, "finite_size": finite_size, "gaussian_heights": gaussian_heights, "hertz": hertz, "holm": holm,
    "greenwood_williamson": greenwood_williamson, "height_distribution": height_distribution, "jaeger": jaeger,
    "leakage": leakage,
    "interaction": interaction, "mindlin": mindlin, "nayak": nayak, "partial_moments": partial_moments, "punch": punch,
    "persson": persson, "persson_separation": persson_separation, "plasticity": plasticity, "thermal": thermal,
    "pohrt_popov": pohrt_popov, "power_law_indenter": power_law_indenter, "rough_sphere": rough_sphere,
    "rough_square": rough_square,
    "two_cosines": two_cosines, "chang_etsion_bogy": chang_etsion_bogy, "kogut_etsion": kogut_etsion,
    "persson_friction": persson_friction,
    "persson_plastic": persson_plastic, "pullen_williamson": pullen_williamson, "ultrasound": ultrasound,
}  # fmt: skip
BODIES = (
    hertz.point(1e9, radius=1e-3, force=1e-2),
    hertz.line(1e9, radius=1e-3, force=1e2, reference_length=1.0),
    hertz.elliptic(1e9, radii=(1e-3, 2e-3), force=1e-2),
    power_law_indenter.contact(1e9, exponent=2.0, coefficient=1e2, force=1e-2),
    cattaneo.SlippingSphere(1e-2, 1e-3, 1e9, 0.3, 0.8),
    bush_gibson_thomas.Summits(ROUGH, 1e9),
    greenwood_williamson.population(ROUGH, 1e9),
    kogut_etsion.population(ROUGH, 1e9, 1e9),
    CELL,
    beat_wave.beat_wave(2, 1e-7),
    stepped.SteppedIndenter(1e-3, 1e-6, 2.0, 0.8),
    two_cosines.Hierarchy(1e-6, 1e4, 3.0, 0.8),
)
CLASSES = (
    cattaneo.SlippingSphere,
    finite_size.Cell,
    greenwood_williamson.Asperity,
    stepped.SteppedIndenter,
    two_cosines.Hierarchy,
)
# Integrals of functions and of samples, and a gap over an interface, take no plain numbers.
ELSEWHERE = {"height_distribution.from_density", "height_distribution.from_samples", "interaction.mean_gap"}


def functions():
    for name, module in MODULES.items():
        for one in module.__all__:
            if inspect.isfunction(getattr(module, one)) and f"{name}.{one}" not in ELSEWHERE:
                yield f"{name}.{one}", getattr(module, one)
    for body in BODIES:
        for one, method in vars(type(body)).items():
            if inspect.isfunction(method) and not one.startswith("_"):
                yield f"{type(body).__name__}.{one}", getattr(body, one)
    for kind in CLASSES:
        yield kind.__name__, kind
    yield "Asperity.hertz", greenwood_williamson.Asperity.hertz


FUNCTIONS = dict(functions())


def arguments(name):
    """Return good values of what the function needs, and those of its arguments that take arrays."""
    parameters = inspect.signature(FUNCTIONS[name]).parameters
    own = OTHERS.get(name, {})
    values = {
        n: own.get(n, GOOD.get(n, p.default)) if p.default is p.empty else own.get(n, p.default)
        for n, p in parameters.items()
        if p.default is p.empty or n in own or isinstance(p.default, float)
    }
    arrays = {n for n in values if "Array" in str(parameters[n].annotation) and isinstance(values[n], float)}
    return values, arrays


def refused(name, **spoilt):
    """Call with some values spoilt; the message is to be ours: one of NumPy's would not help."""
    with pytest.raises(ValueError) as caught:
        FUNCTIONS[name](**arguments(name)[0] | spoilt)
    message = str(caught.value)
    for foreign in ("broadcast together", "could not convert", "truth value", "inhomogeneous", "ufunc"):
        assert foreign not in message
    return message


@functools.cache
def numbers(name):
    values, arrays = arguments(name)
    return tuple((n, n in arrays) for n, value in values.items() if isinstance(value, float))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_good_numbers_are_taken(name):
    FUNCTIONS[name](**arguments(name)[0])


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if numbers(name)])
def test_what_is_no_number_is_refused(name):
    for argument, _ in numbers(name):
        for wrong in ("x", b"1", None, [], object(), np.nan, 1j):
            optional = "None" in str(inspect.signature(FUNCTIONS[name]).parameters[argument].annotation)
            if not (wrong is None and optional) and not (
                isinstance(wrong, list) and argument in arguments(name)[1]
            ):
                refused(name, **{argument: wrong})


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_value_with_a_dimension_is_refused_with_the_number_to_give(name):
    for argument, value in arguments(name)[0].items():
        if isinstance(value, float | np.ndarray):
            assert "plain number" in refused(name, **{argument: value * MILLIMETRE})
        if isinstance(value, float):
            assert f"give {value * 1e-3:.12g}" in refused(name, **{argument: value * MILLIMETRE})
        if isinstance(value, tuple):
            assert "plain number" in refused(name, **{argument: tuple(one * MILLIMETRE for one in value)})


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if numbers(name)])
def test_arrays_where_they_are_taken_hold_no_nan_and_elsewhere_are_refused(name):
    for argument, array in numbers(name):
        good = arguments(name)[0][argument]
        refused(name, **{argument: np.array([good, np.nan if array else good])})


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if sum(a for _, a in numbers(name)) > 1])
def test_shapes_that_do_not_fit_are_told_by_name(name):
    values, arrays = arguments(name)
    names = [n for n in values if n in arrays]
    for first, second in zip(names[1:], names[:-1], strict=True):
        message = refused(name, **{first: np.full(2, values[first]), second: np.full(3, values[second])})
        assert f"{first} (2,)" in message
        assert f"{second} (3,)" in message


@pytest.mark.parametrize(
    "name", [name for name in FUNCTIONS if any(isinstance(v, tuple) for v in arguments(name)[0].values())]
)
def test_pairs_are_two_numbers(name):
    for argument, value in arguments(name)[0].items():
        if isinstance(value, tuple):
            for wrong in (value[0], (*value, 1.0), ("x", value[1]), (np.nan, value[1]), None):
                refused(name, **{argument: wrong})


PLACES = [np.array([0.0, 1.0])] * 4
BANDS = waves.Waves.of_bands
STEPS, CREST = BODIES[-2:]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: BANDS("x", [1.0]), "wavenumber .* must be a number"),
        (lambda: BANDS([1.0, 2.0], "x"), "power .* must be a number"),
        (lambda: BANDS([1.0, 2.0], [1.0]), "one power each"),
        (lambda: BANDS([1.0, np.nan], [1.0, 1.0]), "increasing, positive wavenumbers"),
        (lambda: waves.Waves.of_heights("x", (1.0, 1.0)), "heights .* must be a number"),
        (lambda: waves.Waves.of_heights(np.eye(4), 1.0), "spacing .* must be two"),
        (lambda: waves.Waves.of_heights(np.eye(4), (1.0, "x")), "spacing .* must be a number"),
        (lambda: asperities.Asperities("x", *PLACES[1:], 1.0), r"x \[m\] must be a number"),
        (lambda: asperities.Asperities(*PLACES, "x"), "modulus must be one number"),
        (
            lambda: asperities.Asperities(*PLACES[1:], np.ones(3), 1.0),
            r"of one length .* radius of shape \(3,\)",
        ),
        (lambda: holm.contact_length("x", np.ones((3, 2))), "radii .* must be a number"),
        (lambda: holm.contact_length(np.ones(2), np.ones((3, 2))), r"not \(2,\) and \(3, 2\)"),
        (lambda: height_distribution.from_samples("x", [1.0, 2.0]), "depth .* must be a number"),
        (lambda: height_distribution.from_samples([0.0, 1.0], [1.0]), r"shapes \(2,\) and \(1,\)"),
        (lambda: SPHERE.predict("depth", "x"), "force .* must be a number"),
        (lambda: SPHERE.predict("depth", [1.0, [2.0, 3.0]]), "force .* must be a number"),
        (lambda: STEPS.radii("x"), "count must be a whole number"),
        (lambda: STEPS.stiffness(1.0, 2.5, 1e9), "count must be a whole number"),
        (lambda: CREST.amplitudes(0), "count must be a whole number"),
        (lambda: CREST.corners(-1, 1e9), "count must be a whole number"),
        (lambda: BODIES[2].displacement(np.inf, 0.0), r"x \[m\] must be finite"),
        (lambda: nayak.summit_density(0.0, np.inf, 0.5, 2.0), "mean must be finite"),
        (lambda: nayak.geometric_density(0.0, np.inf, 2.0), "curvature must be finite"),
        (lambda: partial_moments.log_gaussian(1.0, -np.inf), "minus infinity"),
        (lambda: height_distribution.stiffness_exponent(np.inf), "density_exponent must be finite"),
        (lambda: persson_separation.self_affine_decay(np.inf), "Hurst exponent"),
        (
            lambda: persson_separation.reference_pressure(1e9, GOOD["spectrum"], gamma=1e-300),
            "gamma is too small",
        ),
        (lambda: persson.pressure_spread(1e300, ROUGH), "modulus .* must lie between"),
        (lambda: CELL.crossover_force(1e9, 1e300), "decay length .* must lie between"),
        (lambda: mindlin.slip_constant(1.0, 1e-300), "hurst must lie between"),
        (lambda: hertz.law(10**400, 1e9), "must be one number"),
        (lambda: beat_wave.beat_wave("x", 1.0), "modes must be one number"),
        (lambda: beat_wave.beat_wave(np.nan, 1.0), "modes must be a whole number"),
        (lambda: beat_wave.beat_wave(0, 1.0), "modes must be a positive whole number"),
    ],
)
def test_lists_and_counts_are_refused_by_name(call, message):
    with pytest.raises(ValueError, match=message):
        call()
