"""The law of shear: closed forms of cycles, notes, messages, numbers with units, arrays."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pint
import pytest

import roughcontact as rc
from made_laws import exponential, hertz, power
from roughcontact.errors import InputError
from roughcontact.theory import hertz as hertz_law
from roughcontact.theory.joints import jaeger
from roughcontact.theory.joints.cattaneo import SlippingSphere

MU = 0.3
# Cattaneo and Mindlin with E* = R = P = 1: f, loss and displacement for nu = 0, damping for any.
SPHERE = [
    (0.1, 1.179567385e-5, 1.679779086574e-2, 0.0037253704),
    (0.5, 2.093118198223e-3, 9.163825693820e-2, 0.0242351553),
    (0.9, 2.384747464972e-2, 0.1942911440997, 0.0723512032),
]
LOSS_03 = {0.1: 1.432331825e-5, 0.5: 2.541643526414e-3, 0.9: 2.895764778894e-2}
# The exponential law: f, loss over mu^2 C g0 p, damping.
EXPONENTIAL = [
    (0.1, 7.39918999e-4, 0.0111770302),
    (0.5, 0.158883083360, 0.0729629400),
    (0.9, 2.931374409174, 0.2251299245),
]
STEEL = rc.Solid(210e9, 0.3)
GROUND = rc.self_affine(
    rc.Grid((32, 48), (2e-6, 1e-6), periodic=True),
    hurst=0.8,
    rms=1e-7,
    rng=1,
    rolloff=2e-5,
    short_cutoff=5e-6,
)
PRESSURES = np.geomspace(2e6, 5e8, 13)
CURVE = rc.loading_curve(GROUND, (STEEL, STEEL), pressures=PRESSURES)
LAW = rc.shear_law(CURVE, (STEEL, STEEL), friction=0.2)
FREE = rc.shear_law(
    rc.loading_curve(rc.Surface(GROUND.heights, rc.Grid((32, 48), (2e-6, 1e-6))), (STEEL, STEEL), pressures=PRESSURES),
    (STEEL, STEEL),
    friction=0.2,
)  # fmt: skip


def meets_the_sphere(law):
    """The numbers are good to the digits that are given; the law between 500 loads a decade to 1e-9 (see below)."""
    for f, loss, displacement, damping in SPHERE:
        tau = f * MU
        assert law.displacement(tau, 1.0) == pytest.approx(displacement, rel=1e-10)
        assert law.loss(1.0, traction=tau) == pytest.approx(loss, rel=1e-9)
        assert law.cycle(1.0, traction=tau).damping == pytest.approx(damping, rel=1e-7)


@pytest.mark.parametrize("nu", [0.0, 0.3])
def test_a_sphere(nu):
    """Its depth is a power of the force: the law, Jaeger's quadrature and the closed form are one."""
    bodies = (rc.Solid(2 * (1 - nu**2), nu),) * 2
    law, ratio = hertz(bodies=bodies), (2 - nu) / (2 * (1 - nu))
    sphere = SlippingSphere(1.0, 1.0, 1.0, MU, ratio)
    for f, loss, displacement, damping in SPHERE:
        tau, expected = f * MU, LOSS_03[f] if nu else loss
        assert float(sphere.cycle_loss(tau)) == pytest.approx(expected, rel=1e-9)
        # The quadrature to 1e-10 is of terms that are 54/f^2 times the loss.
        assert jaeger.cycle_loss(
            hertz_law.law(1.0, 1.0), 1.0, tau, friction=MU, ratio=ratio
        ) == pytest.approx(expected, rel=1e-6)
        assert law.loss(1.0, traction=tau) == pytest.approx(expected, rel=1e-9)
        assert law.displacement(tau, 1.0) == pytest.approx(ratio * displacement, rel=1e-10)
        assert law.cycle(1.0, traction=tau).damping == pytest.approx(damping, rel=1e-7)
    if not nu:
        meets_the_sphere(law)


def test_a_wrong_friction_or_compliance_is_noticed():
    law = hertz()
    for wrong in (replace(law, friction=1.02 * MU), replace(law, ratio=1.02)):
        with pytest.raises(AssertionError):
            meets_the_sphere(wrong)


@pytest.mark.parametrize("pressure", [1.0, 0.3])
def test_an_exponential_law(pressure):
    """One shape for all pressures. The loss at a tenth of mu p is that of 23 intervals of the law: good to 1e-9."""
    law = exponential()
    for f, loss, damping in EXPONENTIAL:
        tau = f * MU * pressure
        assert law.loss(pressure, traction=tau) == pytest.approx(loss * MU**2 * pressure, rel=1e-9)
        cycle = law.cycle(pressure, traction=tau)
        assert cycle.damping == pytest.approx(damping, rel=1e-8)
        assert cycle.loss == law.loss(pressure, traction=tau)
        s = law.displacement(tau, pressure)
        assert law.traction(s, pressure) == pytest.approx(tau, rel=1e-12)
        assert tau == pytest.approx(MU * pressure * (1 - math.exp(-s / MU)), rel=1e-11)


def test_order_of_the_loss():
    """Between n loads a decade, the loss at half of mu p is good to the fourth power of their distance."""
    errors = []
    for count in (8, 16, 32):
        law = exponential(pressure=np.geomspace(1e-3, 1, 3 * count + 1))
        errors.append(law.loss(1.0, traction=0.9 * MU) / (EXPONENTIAL[2][1] * MU**2) - 1)
    assert errors[0] < 2e-5
    for coarse, fine in pairwise(errors):
        assert coarse / fine == pytest.approx(16, rel=0.1)


@pytest.mark.parametrize("a", [1 / 3, 0.6, 0.9])
def test_a_power_law(a):
    """``tau = mu p [1 - (1 - s/s_max)^(1/(1 - a))]``."""
    law = power(a)
    top = float(law.gross_slip(0.8))
    assert top == pytest.approx(MU * 0.8 ** (1 - a) / (1 - a), rel=1e-12)
    s = top * np.array([0.0, 0.01, 0.3, 0.99, 1.0, 2.0])
    expected = MU * 0.8 * (1 - np.maximum(1 - s / top, 0) ** (1 / (1 - a)))
    np.testing.assert_allclose(law.traction(s, 0.8), expected, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(law.stiffness([0.2, 0.8]), np.array([0.2, 0.8]) ** a, rtol=1e-8)


def test_traction_is_limited_by_friction_and_displacement_by_rounding():
    """At mu p the whole contact slips, at no displacement rounding leaves nothing, and the highest load is inside."""
    assert LAW.displacement(0.2 * 1e8, 1e8) == pytest.approx(float(LAW.gross_slip(1e8)), rel=1e-14)
    assert LAW.traction(0.0, 1e8) == pytest.approx(0, abs=1e-6)
    assert LAW.loss(1e8, displacement=0.0) == 0 == LAW.loss(1e8, traction=0.0)
    assert LAW.cycle(1e8, traction=0.0).damping == 0
    highest = LAW.normal.highest
    assert LAW.traction(LAW.displacement(0.1 * highest, highest), highest) == pytest.approx(
        0.1 * highest, rel=1e-10
    )


@pytest.mark.parametrize("law", [hertz(), exponential(), power(0.9)])
@pytest.mark.parametrize("part", [0.3, 0.9])
def test_the_loss_is_the_area_of_the_loop(law, part):
    """Trapezoids over 100 steps of each branch, quadratic in the fall: good to a part of their square."""
    cycle = law.cycle(0.8, traction=part * MU * 0.8)
    s, q = cycle.displacement, cycle.traction
    assert (s[0], q[0]) == (s[-1], q[-1]) == (-s[100], -q[100])
    area = float(((q[1:] + q[:-1]) / 2 * np.diff(s)).sum())
    assert area == pytest.approx(cycle.loss, rel=2e-3)
    assert cycle.damping == pytest.approx(cycle.loss / (2 * math.pi * q[0] * s[0]), rel=1e-14)


def test_beyond_gross_slip_the_surfaces_slide():
    """Each half of the cycle slides by twice the distance beyond gross slip, under mu p."""
    law = hertz()
    top = float(law.gross_slip(1.0))
    at_top = law.loss(1.0, traction=MU)
    assert law.loss(1.0, displacement=top) == pytest.approx(at_top, rel=1e-12)
    assert law.loss(1.0, displacement=top + 0.1) == pytest.approx(at_top + 4 * MU * 0.1, rel=1e-12)
    cycle = law.cycle(1.0, displacement=top + 0.1)
    assert cycle.displacement.max() == pytest.approx(top + 0.1, rel=1e-12)
    assert len(cycle.traction) == 203
    area = ((cycle.traction[1:] + cycle.traction[:-1]) / 2 * np.diff(cycle.displacement)).sum()
    assert area == pytest.approx(cycle.loss, rel=2e-3)


def test_just_before_gross_slip_the_displacement_counts():
    """There the traction is mu p to rounding, at a tenth power of the distance: it does not give the displacement."""
    law = power(0.9)
    top = float(law.gross_slip(0.5))
    s, (q, weights) = 0.98 * top, np.polynomial.legendre.leggauss(60)
    # W = 8 int tau ds - 4 s tau(s), of the closed form
    rise = MU * 0.5 * (1 - (1 - 0.49 * (1 + q)) ** 10)
    expected = 8 * rise @ weights * s / 2 - 4 * s * MU * 0.5 * (1 - 0.02**10)
    assert law.loss(0.5, displacement=s) == pytest.approx(expected, rel=1e-9)
    assert law.cycle(0.5, displacement=s).displacement[0] == pytest.approx(s, rel=1e-12)


@pytest.mark.parametrize(
    ("f", "by_displacement", "by_traction"),
    [(0.01, 2.995, 3.01), (0.1, 2.948, 3.11), (0.5, 2.677, 3.86), (0.9, 2.104, 8.2), (0.99, 1.627, 35.0)],
)
def test_the_loss_grows_with_the_cube_of_small_amplitudes(f, by_displacement, by_traction):
    """Local slopes of the exponential law, to the digits that are given; differences over 2 % of them, or of 1 - f."""
    law, tau = (
        exponential(pressure=np.geomspace(1e-3, 1, 6001)),
        MU * (f + min(f, 1 - f) * np.array([-0.01, 0.01])),
    )
    growth = math.log(law.loss(1.0, traction=tau[1]) / law.loss(1.0, traction=tau[0]))
    assert growth / math.log(tau[1] / tau[0]) == pytest.approx(by_traction, rel=6e-3)
    s = law.displacement(tau, 1.0)
    assert growth / math.log(s[1] / s[0]) == pytest.approx(by_displacement, abs=6e-4)


def test_a_computed_surface_loses_with_the_cube_of_its_amplitude():
    """The fitted law of a rough surface: slopes of 2.9 to 3.0 up to a tenth of mu p, towards 1 beyond gross slip."""
    law, p = LAW.fitted, 1e8
    tau = 0.2 * p * np.array([0.003, 0.01, 0.03, 0.1])
    s = law.displacement(tau, p)
    slopes = np.diff(np.log([law.loss(p, traction=each) for each in tau])) / np.diff(np.log(s))
    assert ((slopes > 2.9) & (slopes < 3.0)).all()
    far = float(law.gross_slip(p)) * np.array([100.0, 200.0])
    assert math.log2(law.loss(p, displacement=far[1]) / law.loss(p, displacement=far[0])) == pytest.approx(
        1, abs=0.01
    )


def test_no_loss_of_single_cells_is_given():
    """On the map the law ends at one over the root of the cells; a fitted law has none."""
    p = 1e7
    least = LAW.smallest_share(p)
    cells = np.interp(p, LAW.normal.pressure, LAW.normal.cells)
    assert 0 < least < 1
    assert least == pytest.approx(1 / math.sqrt(cells))
    assert LAW.loss(p, traction=1.01 * least * 0.2 * p) > 0
    with pytest.raises(InputError, match=r"only single cells of the map slip .* use the law `fitted`"):
        LAW.loss(p, traction=0.99 * least * 0.2 * p)
    small = LAW.displacement(0.9 * least * 0.2 * p, p)
    with pytest.raises(InputError, match="only single cells") as caught:
        LAW.cycle(p, displacement=float(small))
    assert caught.value.place == "displacement"
    assert LAW.fitted.smallest_share(p) == 0
    assert LAW.fitted.loss(p, displacement=float(small)) > 0


def test_a_contact_of_one_cell_slips_as_a_whole():
    """Its closure is straight, so that no part slips before the whole."""
    grid = rc.Grid((16, 16), 1e-6, periodic=True)
    peak = np.zeros((16, 16))
    peak[5, 7] = 1e-6
    curve = rc.loading_curve(rc.Surface(peak, grid), (STEEL, STEEL), pressures=[1e6, 2e6, 4e6])
    law = rc.shear_law(curve, (STEEL, STEEL), friction=0.2)
    assert (law.normal.cells == 1).all()
    assert law.smallest_share(2e6) == 1
    with pytest.raises(InputError, match="only single cells"):
        law.loss(2e6, traction=0.399e6)
    # The certificate of three loads is 1e-8 of their displacements.
    whole = 4 * 0.2 * 2e6 * float(law.gross_slip(2e6))
    assert law.loss(2e6, traction=0.4e6) == pytest.approx(0, abs=1e-7 * whole)
    assert law.fitted.loss(2e6, traction=0.2e6) == pytest.approx(0, abs=1e-7 * whole)


def test_a_free_map_ends_at_its_lowest_load():
    p, low = 1e8, PRESSURES[0]
    assert math.isnan(FREE.gross_slip(p))
    most = 0.2 * (p - low)
    s = FREE.displacement(most, p)
    assert FREE.loss(p, displacement=float(s)) == pytest.approx(FREE.loss(p, traction=most), rel=1e-9)
    assert np.isnan(FREE.traction(1.1 * s, p))
    for wrong in ({"traction": 0.2 * p}, {"displacement": float(1.1 * s)}):
        with pytest.raises(
            InputError, match=r"lies below the lowest load .* first touch is not known"
        ) as caught:
            FREE.loss(p, **wrong)
        assert caught.value.place in wrong


def test_arrays_of_tractions_and_pressures():
    p = np.array([1e7, 5e7, 1e8])
    tau = np.array([[0.0], [1e6]])
    s = LAW.displacement(tau, p)
    assert s.shape == (2, 3)
    np.testing.assert_allclose(LAW.traction(s, p), np.broadcast_to(tau, (2, 3)), rtol=1e-9, atol=1e-3)
    assert s[1, 2] == LAW.displacement(1e6, 1e8)
    with pytest.raises(InputError, match="shapes do not fit"):
        LAW.displacement(np.ones(2), p)
    with pytest.raises(InputError, match=r"exceeds mu p .*given: 3e\+06"):
        LAW.displacement([1e6, 3e6], [1e8, 1e7])


def test_numbers_with_units():
    U = pint.get_application_registry()
    assert LAW.displacement(1 * U.MPa, 100 * U.MPa) == LAW.displacement(1e6, 1e8)
    assert LAW.loss(100 * U.MPa, traction=5 * U.MPa) == LAW.loss(1e8, traction=5e6)
    assert LAW.cycle(1e8, displacement=20 * U.nm).loss == pytest.approx(
        LAW.loss(1e8, displacement=2e-8), rel=1e-12
    )
    assert LAW.stiffness(1e4 * U.N / U.cm**2) == LAW.stiffness(1e8)
    for wrong in (lambda: LAW.displacement(1 * U.N, 1e8), lambda: LAW.smallest_share(1 * U.m)):
        with pytest.raises(InputError, match="Pa"):
            wrong()


class TestExactness:
    def law(self, *bodies, **named):
        curve = rc.loading_curve(GROUND, bodies, pressures=PRESSURES[::4])
        return rc.shear_law(curve, bodies, friction=0.3, **named)

    def test_alike_bodies_of_poissons_ratio_0(self):
        law = self.law(rc.Solid(1e11, 0.0), rc.Solid(1e11, 0.0), exact=True)
        assert (law.exact, law.fitted.exact, law.ratio, law.notes) == (True, True, 1.0, ())

    @pytest.mark.parametrize(
        ("bodies", "notes"),
        [
            ((STEEL, STEEL), ["exact for Poisson's ratio 0"]),
            ((rc.Solid(1e9, 0.0), rc.Solid(1e11, 0.0)), ["bodies are unlike"]),
            ((rc.Solid(1e9, 0.3), rc.Solid(1e11, 0.3)), ["bodies are unlike", "exact for Poisson's ratio 0"]),
            ((rc.Solid(1e9, 0.5),), ["exact for Poisson's ratio 0"]),  # a rubber on a rigid body is alike
            ((rc.Solid(1e9, 0.0),), ["bodies are unlike"]),
        ],
    )
    def test_other_bodies(self, bodies, notes):
        law = self.law(*bodies)
        assert not law.exact
        assert [next(part for part in notes if part in note) for note in law.notes] == notes
        with pytest.raises(
            InputError,
            match="exact only for alike bodies of Poisson's ratio 0 and for periodic maps: leave out `exact`",
        ):
            self.law(*bodies, exact=True)

    def test_free_maps(self):
        """The mean displacement of the surfaces is then not that of the bodies, whose work friction dissipates."""
        flat = rc.Surface(GROUND.heights, rc.Grid((32, 48), (2e-6, 1e-6)))
        bodies = (rc.Solid(1e11, 0.0), rc.Solid(1e11, 0.0))
        loop = rc.loading_loop(flat, bodies, hardness=5e9, pressures=PRESSURES[-3:])
        for pressed in (rc.loading_curve(flat, bodies, pressures=PRESSURES[-3:]), loop):
            law = rc.shear_law(pressed, bodies, friction=0.2)
            assert (law.exact, law.normal.free, law.normal.fitted.free) == (False, True, True)
            assert sum("dissipates more" in note for note in law.notes) == 1
        assert not LAW.normal.free
        assert not any("dissipates more" in note for note in LAW.notes)

    def test_unlike_but_not_coupled(self):
        """Dundurs's parameter vanishes for equal G/(1 - 2 nu) only; nu = 0.5 on both sides is such a pair."""
        law = self.law(rc.Solid(1e9, 0.5), rc.Solid(1e11, 0.5))
        assert not law.exact
        assert len(law.notes) == 1


def test_notes_on_flow_strength_and_first_touch():
    loop = rc.loading_loop(GROUND, (STEEL, STEEL), hardness=5e9, pressures=PRESSURES)
    law = rc.shear_law(loop, (STEEL, STEEL), friction=0.2)
    assert any("junction growth" in note for note in law.notes)
    assert not any("junction growth" in note for note in LAW.notes)
    assert any(f"p - tau/mu is {PRESSURES[0]:.3g} Pa" in note for note in FREE.notes)
    assert not any("first touch" in note for note in LAW.notes)
    means = 0.2 * PRESSURES / CURVE.contact_fraction
    strong = replace(LAW, shear_strength=1.01 * means.max())
    assert not any("shear strength" in note for note in strong.notes)
    weak = rc.shear_law(CURVE, (STEEL, STEEL), friction=0.2, shear_strength=0.99 * means.max())
    assert weak.notes[0].startswith(f"From {PRESSURES[int(np.argmax(means > 0.99 * means.max()))]:.3g} Pa on")
    assert "Coulomb's law is wrong there" in weak.notes[0]


@pytest.mark.parametrize("friction", [0.0, -0.3, math.nan, math.inf, None, "0.3"])
def test_friction_is_positive(friction):
    with pytest.raises(InputError, match="friction"):
        rc.shear_law(CURVE, (STEEL, STEEL), friction=friction)


def test_what_is_no_law():
    steel, rubber = STEEL, rc.Solid(1e7, 0.5)
    for wrong, message in (
        (
            lambda: rc.shear_law(CURVE, rubber, friction=0.3),
            "reduced modulus of 1.33333e.07 Pa, but were pressed with",
        ),
        (
            lambda: rc.shear_law(GROUND, steel, friction=0.3),
            "must be a Curve, as .* or a Loop, not a Surface",
        ),
        (lambda: rc.shear_law(CURVE, (steel, steel), friction=0.3, shear_strength=0), "shear strength"),
        (lambda: LAW.loss(1e8), "give exactly one of traction and displacement"),
        (lambda: LAW.loss(1e8, traction=1e6, displacement=1e-9), "give exactly one"),
        (lambda: LAW.loss(1e8, traction=-1e6), "traction .* not negative"),
        (lambda: LAW.loss(1e8, displacement=-1e-9), "displacement .* not negative"),
        (
            lambda: LAW.loss(1e8, traction=2.1e7),
            "the surfaces slide .*; give a smaller traction, or a displacement",
        ),
        (lambda: LAW.loss(6e8, traction=2.1e7), "the law holds from 0 to 5e.08 Pa"),
        (lambda: LAW.displacement(1e6, -1.0), "pressure|exceeds"),
        (lambda: LAW.displacement(math.nan, 1e8), "must be a number"),
        (lambda: LAW.traction(-1e-9, 1e8), "not negative"),
        (lambda: LAW.stiffness("a"), "in SI units"),
    ):
        with pytest.raises(InputError, match=message):
            wrong()
    assert repr(LAW) == "ShearLaw(friction 0.2, E*/G* 1.214, 13 loads, 2e+06 to 5e+08 Pa)"
