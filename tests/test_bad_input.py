"""Every number that a public function takes, spoilt in turn: a ValueError of ours, and nothing raw from below.

The theories have a test of their own, tests/theory/test_bad_input.py.
"""

import inspect

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.validation import NUMBERS, WHOLE

N = 16
PERIODIC, FREE = rc.Grid((N, N), 1e-6, True), rc.Grid((N, N), 1e-6)
LINE, RING = rc.Grid(65, 1e-6), rc.RadialGrid.uniform(5, 1e-3)
STEEL = rc.Solid(1e9, 0.3)


def rng():
    return np.random.default_rng(0)


ROUGH = rc.self_affine(PERIODIC, 0.8, 1e-7, rng(), amplitudes="gaussian")
CUT = rc.Surface(ROUGH.heights, FREE)
SCAN = rc.Surface(
    rc.self_affine(rc.Grid(256, 1e-6, True), 0.8, 1e-7, rng()).heights, rc.Grid(256, 1e-6, True)
)
SPECTRUM = rc.PowerSpectrum(*(np.geomspace(1e5, 1e6, 9),) * 2, "C2D", *(np.full(9, 9.0),) * 2, 1e5, 1e6)
LAW = rc.SelfAffineSpectrum(0.8, 1e-5, None, 1e-6)
PRESSED = rc.press(CUT, STEEL, force=1e-4)
DERIVATIVES = rc.sensitivity(PRESSED)
MASK = np.pad(np.ones((4, 4), bool), 6)
TIP = rc.mdr.indenter.paraboloid(1e-2)
STICKY = rc.mdr.adhesion.jkr(TIP, 1e9, 0.05)
SOFT = rc.viscoelastic.standard_solid(1e8, 1e9, 1.0)
HISTORY = rc.mdr.viscoelastic_history
# What is called, and good arguments.
CALLS = {
    rc.Solid: {"young_modulus": 1e11, "poisson_ratio": 0.3},
    rc.Moments: {"m0": 1e-14, "m2": 1e-2, "m4": 1e12, "dimension": 2},
    rc.SelfAffineSpectrum: {"hurst": 0.8, "rolloff": 1e-5, "short_cutoff": 1e-6, "scale": 1.0},
    rc.StretchedSpectrum: {"spectrum": LAW, "ratio": 2.0, "angle": 0.3},
    rc.Force: {"value": 1.0},
    rc.Depth: {"value": 1.0},
    rc.ActiveSet: {"max_steps": 50, "dense_limit": 100},
    rc.PolonskyKeer: {"max_steps": 50},
    LAW.scaled: {"rms": 1e-7},
    ROUGH.filtered: {"short_cutoff": 4e-6, "long_cutoff": 1e-5},
    CUT.tapered: {"window": "hann", "share": 0.2},
    ROUGH.scanned: {"tip_radius": 1e-5},
    ROUGH.rotated: {"quarters": 1},
    rc.self_affine: {"grid": PERIODIC, "hurst": 0.8, "rms": 1e-7, "rng": rng(), "short_cutoff": 3e-6},
    rc.synthesise: {"grid": PERIODIC, "spectrum": LAW, "rng": rng(), "rms": 1e-7},
    rc.midpoint_line: {"grid": LINE, "hurst": 0.8, "rng": rng(), "rms": 1e-7},
    rc.magnify: {"surface": ROUGH, "factor": 2.0, "hurst": 0.8},
    rc.fractal_dimension: {"hurst": 0.8, "dimension": 2},
    SPECTRUM.within: {"q_min": 2e5, "q_max": 8e5},
    SPECTRUM.rebinned: {"per_decade": 5.0},
    rc.power_spectrum: {"surface": ROUGH, "per_decade": 20.0},
    rc.fit_spectrum: {"spectrum": SPECTRUM, "q_min": 1e5, "q_max": 1e6},
    rc.merge_spectra: {"spectra": [SPECTRUM], "per_decade": 20.0},
    rc.cut_factor: {"hurst": 0.8},
    rc.height_histogram: {"surface": ROUGH, "bins": 10},
    rc.spectrum_moments: {"spectrum": SPECTRUM, "q_min": 1e5, "q_max": 1e6},
    rc.areal_parameters: {"surface": ROUGH, "decay": 0.2},
    rc.profile_parameters: {"line": SCAN, "section_length": 50e-6},
    rc.stratified_parameters: {"surface": ROUGH, "peak_ratio": 0.1, "dale_ratio": 0.8},
    rc.singly_periodic: {"grid": rc.Grid((4, 4), 1e-6, (True, False)), "modulus": 1e9, "reference_length": 1e-3},
    rc.line: {"grid": LINE, "modulus": 1e9, "reference_length": 1e-3},
    rc.layer: {"grid": FREE, "modulus": STEEL, "thickness": 1e-5, "base": "bonded"},
    rc.tangential_stiffness: {"mask": MASK, "grid": FREE, "bodies": STEEL, "tolerance": 1e-7},
    rc.slide: {"solution": PRESSED, "bodies": STEEL, "friction": 0.3, "force": 1e-5, "tolerance": 1e-8},
    rc.shear_cycle: {"solution": PRESSED, "bodies": STEEL, "friction": 0.3, "traction": 1e5, "steps": 1,
                     "shear_strength": 1e8, "tolerance": 1e-8},
    rc.load_cycle: {"amplitude": 1e-5, "cycles": 1, "steps": 8},
    rc.press: {"surface": CUT, "modulus": 1e9, "force": 1e-4, "tolerance": 1e-8, "hardness": 1e12},
    rc.viscoelastic_path: {"surface": CUT, "material": SOFT, "times": [0, 1], "forces": [0, 1], "time_tolerance": 0.1},
    rc.viscoelastic_curve: {"surface": CUT, "material": SOFT, "times": [0, 1], "forces": [0, 1e-4], "steps": 1},
    rc.contact_stiffness: {"mask": MASK, "grid": FREE, "modulus": 1e9, "tolerance": 1e-7},
    rc.load_range: {"surface": CUT, "modulus": 1e9, "count": 5},
    DERIVATIVES.to_radius: {"radius": 1e-3},
    rc.differentiable_curve: {"grid": FREE, "modulus": 1e9, "forces": [1e-4], "tolerance": 1e-8},
    PRESSED.pressure_histogram: {"bins": 5},
    rc.shapes.cone: {"grid": FREE, "slope": 0.1},
    rc.shapes.cylinder: {"grid": FREE, "radius": 1e-3},
    rc.shapes.flat_disc: {"grid": FREE, "radius": 5e-6},
    rc.shapes.flat_ring: {"grid": FREE, "inner": 2e-6, "outer": 5e-6},
    rc.shapes.flat_square: {"grid": FREE, "side": 5e-6},
    rc.shapes.flat_triangle: {"grid": FREE, "side": 5e-6},
    rc.shapes.paraboloid: {"grid": FREE, "radius": 1e-3},
    rc.shapes.power_law: {"grid": FREE, "exponent": 2.0, "coefficient": 3.0},
    rc.shapes.sphere: {"grid": FREE, "radius": 1e-3},
    rc.shapes.wave: {"grid": PERIODIC, "amplitude": 1e-7, "wavelength": 8e-6},
    STICKY.energy: {"radius": 1e-5, "depth": 1e-8},
    rc.mdr.adhesive_path.adhesive_path: {"adhesion": STICKY, "depths": [0.0, 1e-8], "machine_stiffness": 1e5},
    rc.mdr.indenter.equivalent_roughness: {"hurst": 0.8, "rms": 1e-7, "length": 1e-3, "prefactor": 1.0},
    rc.mdr.lattice_sums.line_sum: {"exponent": 2.6, "modes": 10},
    rc.mdr.lattice_sums.square_sum: {"exponent": 3.6, "modes": 10},
    rc.mdr.random_lines.random_waves: {"grid": SCAN.grid, "rng": rng(), "count": 2},
    HISTORY.depth_history: {"profile": TIP, "material": SOFT, "times": [0.0, 1.0], "depths": [0.0, 1e-8], "springs": 9},
}  # fmt: skip
BAD = ("a", b"1", None, np.nan, 1j, np.array([1.0, 2.0]), [], object(), 10**400)
FOREIGN = (
    "broadcast together",
    "could not convert",
    "truth value",
    "inhomogeneous",
    "setting an array",
    "math domain",
)


def spoilable():
    for call, good in CALLS.items():
        parameters = inspect.signature(call).parameters
        for name in good:
            kind = str(parameters[name].annotation)
            if kind.removesuffix(" | None") in NUMBERS | WHOLE or name in ("modulus", "hardness"):
                yield pytest.param(call, name, "None" in kind, id=f"{call.__qualname__}-{name}")


@pytest.mark.parametrize("call", CALLS, ids=lambda call: call.__qualname__)
def test_good_numbers_are_taken(call):
    call(**CALLS[call])


@pytest.mark.parametrize(("call", "name", "optional"), list(spoilable()))
def test_what_is_no_number_is_refused(call, name, optional):
    for wrong in BAD:
        if wrong is None and optional:
            continue
        with pytest.raises(ValueError) as caught:
            call(**CALLS[call] | {name: wrong})
        assert not any(words in str(caught.value) for words in FOREIGN)


@pytest.mark.parametrize(
    "call",
    [
        lambda: rc.Grid(8, 10**400),
        lambda: rc.RadialGrid.uniform(5, 10**400),
        lambda: ROUGH.downsampled(None),
        lambda: ROUGH.averaged(2.5),
        lambda: rc.self_affine(PERIODIC, 0.8, 1e-7, rng(), anisotropy=2.0),
        lambda: rc.shapes.paraboloid(FREE, 1e-3, ("a", 0.0)),
        lambda: rc.power_spectrum(ROUGH, per_decade=np.inf),
        lambda: rc.power_spectrum(ROUGH, per_decade=1e12),  # tera of bins
        lambda: rc.profile_parameters(SCAN, section_length=np.inf),
        lambda: rc.cut_factor(np.inf),
        lambda: rc.magnify(ROUGH, 2.0, 1e300),
        lambda: rc.below(PRESSED, "a", 0.3),
        lambda: rc.below(PRESSED, 1e-6, "a"),
        lambda: rc.prescribed_displacement(MASK, None, operator=rc.half_space(FREE, 1e9)),
        lambda: rc.loading_curve(CUT, 1e9, forces=["a", 1.0]),
        lambda: rc.loading_curve(CUT, 1e9, forces=[1e-5, 1e-4]).fit((None, 1.0)),
        lambda: rc.slide(PRESSED, STEEL, friction=0.3, force=(1e-5, [1.0, 2.0])),
        lambda: rc.conductance(PRESSED, resistivities=(np.ones(2), 1.0)),
    ],
)
def test_lists_and_extremes_are_refused(call):
    with pytest.raises(ValueError) as caught:
        call()
    assert not any(words in str(caught.value) for words in FOREIGN)


def test_whole_numbers_are_good_sizes():
    heights = ROUGH.heights[:1] * 1e6
    curves = rc.mdr.sliding_friction.sliding_friction(
        heights, 1, 1e9, relaxation_time=1, force=1e7, speeds=[1]
    )
    assert np.isfinite(curves.friction_force).all()
