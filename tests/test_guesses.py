"""Names that new users guess: each works, or its error says what is meant; and values are values."""

import copy
import dataclasses
import pickle
from functools import reduce

import numpy as np
import pytest

import public_names
import roughcontact as rc
from roughcontact.errors import InputError
from roughcontact.guesses import MEANT
from roughcontact.labels.adhesive_columns import ADHESIVE_CURVE
from roughcontact.labels.column import names_of
from roughcontact.labels.contact_columns import CURVE, FLOW
from roughcontact.solver.loads import Loads

STEEL, ALUMINIUM = rc.handbook("steel"), rc.handbook("aluminium")
BALL = rc.shapes.paraboloid(rc.Grid((16, 16), 1e-6), radius=1e-4)
SOLUTION = rc.press(BALL, 1e9, force=1e-4)
CURVE_OF_BALL = rc.loading_curve(BALL, 1e9, forces=[1e-4, 2e-4, 4e-4])
LOOP = rc.loading_loop(BALL, 1e11, hardness=2e9, forces=[5e-3, 1e-2])
RINGS = rc.RadialGrid.uniform(30, radius=6e-7)
ADHESION = rc.Adhesion(work=10e-3, range=4e-9)
STICKY = rc.adhesive_loop(
    rc.RadialProfile(-(RINGS.radii**2) / 2e-5, RINGS), 1e8, ADHESION, depth=10e-9, points=6
)
CYCLE = rc.shear_cycle(
    rc.press(BALL, STEEL.solid, force=1e-1), STEEL.solid, friction=0.3, traction=1e6, steps=1
)
N = np.zeros((4, 8))
# Every line of the list of guesses that failed: what is written, and what it gives, or a word of the error.
WORK = {
    "rc.Surface(N, 1e-6)": lambda: rc.Surface(N, 1e-6).grid == rc.Grid((4, 8), 1e-6),
    "rc.reduced_modulus('steel', 'aluminium')": lambda: (
        rc.reduced_modulus("steel", "aluminium") == rc.reduced_modulus(STEEL.solid, ALUMINIUM.solid)
    ),
    "rc.reduced_modulus(rc.handbook('steel'), rc.handbook('aluminium'))": lambda: (
        rc.reduced_modulus(STEEL, ALUMINIUM) == rc.reduced_modulus(STEEL.solid, ALUMINIUM.solid)
    ),
    "hardness=rc.handbook('aluminium')": lambda: _hardness(ALUMINIUM) == ALUMINIUM.hardness,
    "hardness='aluminium'": lambda: _hardness("aluminium") == ALUMINIUM.hardness,
    "rng=1": lambda: np.array_equal(_rough(1), _rough(np.random.default_rng(1))),
    "rc.Grid(shape, size=)": lambda: rc.Grid((4, 8), size=8e-6) == rc.Grid((4, 8), 1e-6),
    "surface.shape": lambda: BALL.shape == (16, 16),
    "solution.max_pressure": lambda: SOLUTION.max_pressure == SOLUTION.pressure.max(),
    "solution.mean_pressure": lambda: SOLUTION.mean_pressure == SOLUTION.force / SOLUTION.contact_area,
    "solution.nominal_pressure": lambda: SOLUTION.nominal_pressure == SOLUTION.force / BALL.grid.area,
    "solution.interfacial_stiffness_per_area": lambda: (
        SOLUTION.interfacial_stiffness_per_area == SOLUTION.interfacial_stiffness / BALL.grid.area
    ),
    "curve[0]": lambda: CURVE_OF_BALL[0].force == CURVE_OF_BALL.force[0],
    "for point in curve": lambda: [point.depth for point in CURVE_OF_BALL] == CURVE_OF_BALL.depth.tolist(),
}
SAY = {
    "rc.load": "did you mean rc.read?",
    "rc.curve": "did you mean rc.loading_curve?",
    "surface.periodic": "did you mean grid.periodic?",
    "surface.crop": "did you mean cropped?",
    "surface.despike": "did you mean despiked?",
    "surface.level": "did you mean levelled?",
    "solution.area": "did you mean contact_area?",
    "solution.corrected_contact_area": "did you mean rc.error_budget(solution)['corrected_contact_area']?",
    "rc.corrected_contact_area": "did you mean rc.error_budget(solution)['corrected_contact_area']?",
    "solution.gradient": "did you mean rc.sensitivity(solution)?",
    "curve.gradient": "did you mean rc.sensitivity(solution) of each solution of rc.loading_path?",
    "rc.gradient": "did you mean rc.sensitivity?",
    "solution.to_dataframe": "did you mean to_record() or to_dataset()?",
    "curve.pressure": "did you mean nominal_pressure?",
    "curve.area": "did you mean contact_area?",
    "curve.to_pandas": "did you mean to_dataframe()?",
    "curve.to_xarray": "did you mean to_dataset()?",
    "curve.save": "did you mean rc.write(curve, 'curve.nc') or to_csv('curve.csv')?",
}
OWNERS = {"rc": rc, "surface": BALL, "solution": SOLUTION, "curve": CURVE_OF_BALL}
# Of these Python itself says which argument is missing or not known.
REFUSED = {
    "rc.Surface(array)": (lambda: rc.Surface(N), "missing 1 required positional argument: 'grid'"),
    "rc.press(load=)": (lambda: rc.press(BALL, 1e9, load=1.0), "keyword argument 'load'"),
    "rc.press(n=)": (lambda: rc.press(BALL, 1e9, n=1.0), "keyword argument 'n'"),
    "rc.Solid(E=, nu=)": (lambda: rc.Solid(E=1e9, nu=0.3), "keyword argument 'E'"),
    "rc.Solid(young=, poisson=)": (lambda: rc.Solid(young=1e9, poisson=0.3), "keyword argument 'young'"),
    "seed=1": (lambda: rc.self_affine(BALL.grid, 0.8, 1e-7, seed=1), "'seed'|required positional argument"),
    "rc.conductance(..., conductivity=)": (
        lambda: rc.conductance(CURVE_OF_BALL, conductivity=200.0),
        "keyword argument 'conductivity'",
    ),
    "progress=True": (lambda: rc.loading_curve(BALL, 1e9, progress=True), "keyword argument 'progress'"),
}


def _rough(rng):
    return rc.self_affine(BALL.grid, hurst=0.8, rms=1e-7, rng=rng).heights


def _hardness(value):
    return rc.press(BALL, 1e11, force=1e-2, hardness=value).problem.hardness


@pytest.mark.parametrize("line", WORK)
def test_a_guess_works(line):
    assert WORK[line]()


@pytest.mark.parametrize(("line", "hint"), SAY.items())
def test_a_guess_is_answered(line, hint):
    owner, _, name = line.partition(".")
    with pytest.raises(AttributeError) as caught:
        getattr(OWNERS[owner], name)
    assert str(caught.value).endswith(hint)
    assert not hasattr(OWNERS[owner], name)


@pytest.mark.parametrize("line", REFUSED)
def test_an_unknown_keyword_stays_an_error_of_python(line):
    call, words = REFUSED[line]
    with pytest.raises(TypeError, match=words):
        call()


def test_a_curve_writes_the_file_that_write_makes(tmp_path):
    for name, answer in {"curve": CURVE_OF_BALL, "loop": LOOP, "sticky": STICKY}.items():
        rc.write(answer, tmp_path / f"{name}.csv")
        answer.to_csv(tmp_path / f"{name}.txt")  # whatever the extension
        assert (tmp_path / f"{name}.txt").read_bytes() == (tmp_path / f"{name}.csv").read_bytes()


@pytest.mark.parametrize("name", ["persson", "Persson", "PERSSON"])
def test_a_theory_by_its_name_needs_the_surface(name):
    surface = rc.self_affine(rc.Grid((16, 16), 1e-6, periodic=True), hurst=0.8, rms=1e-7, rng=1)
    assert [law.name for law in rc.loading_laws(surface, 1e9, name)] == ["Persson"]
    with pytest.raises(InputError, match=rf"give rc\.loading_laws\(surface, modulus, '{name}'\)\[0\]"):
        CURVE_OF_BALL.compare(name)


# Hints.


EXAMPLES = {
    "roughcontact": rc,
    **{type(value).__name__: value for value in (BALL, SOLUTION, CURVE_OF_BALL, LOOP, STICKY)},
    **{type(value).__name__: value for value in (STEEL, STEEL.solid)},
}
HINTS = [(owner, name) for owner in EXAMPLES for name in MEANT[owner]]


@pytest.mark.parametrize(("owner", "name"), HINTS)
def test_each_hint_leads_to_a_name_that_exists(owner, name):
    assert not hasattr(EXAMPLES[owner], name)
    for meant in MEANT[owner][name].split(" or "):
        path = meant.partition("(")[0]
        start = rc if path.startswith("rc.") else EXAMPLES[owner]
        assert reduce(getattr, path.removeprefix("rc.").split("."), start) is not None


def test_a_name_like_no_other_is_refused_as_python_does():
    with pytest.raises(AttributeError, match=r"^'Curve' object has no attribute 'zzz'$"):
        _ = CURVE_OF_BALL.zzz


def test_a_property_that_fails_keeps_its_own_error():
    @rc.guesses.hinted
    @dataclasses.dataclass(frozen=True)
    class Broken:
        @property
        def width(self):
            return self.height.inner

    with pytest.raises(AttributeError, match="no attribute 'height'"):
        _ = Broken().width


@pytest.mark.parametrize(
    "value", [BALL, SOLUTION, CURVE_OF_BALL, LOOP, STICKY], ids=lambda v: type(v).__name__
)
def test_hints_leave_copies_pickles_and_lists_of_names_as_they_are(value):
    for again in (pickle.loads(pickle.dumps(value)), copy.copy(value), copy.deepcopy(value)):
        assert type(again) is type(value)
        assert repr(again) == repr(value)
    assert "area" not in dir(value)
    assert getattr(value, "zzz", None) is None


FROZEN = (BALL, STEEL, STEEL.solid, BALL.grid, RINGS, ADHESION, STICKY, SOLUTION, CURVE_OF_BALL, LOOP, CYCLE)


@pytest.mark.parametrize("value", FROZEN, ids=lambda value: type(value).__name__)
def test_a_frozen_value_says_so(value):
    names = [each.name for each in dataclasses.fields(value)] + ["rms", "area", "zzz"]
    for name in names:
        with pytest.raises(dataclasses.FrozenInstanceError, match=f"cannot set '{name}': a .* is frozen"):
            setattr(value, name, 1.0)


# Surfaces and grids.


def test_a_surface_is_written_in_a_line():
    long = BALL
    for _ in range(9):
        long = long.levelled("plane")
    noted = rc.Surface(BALL.heights, BALL.grid, ("a note\nof two lines",))
    for surface in (BALL, long, noted):
        assert "\n" not in repr(surface)
        assert len(repr(surface)) < 180
    assert repr(rc.Surface(N, 1e-6)).endswith("heights as given)")
    assert repr(long).endswith(" ...)")


def test_an_array_of_a_surface_is_a_copy_of_its_heights():
    for array in (np.asarray(BALL), np.array(BALL), np.asarray(BALL, copy=True)):
        assert array.dtype == np.float64
        assert np.array_equal(array, BALL.heights)
        assert not np.shares_memory(array, BALL.heights)
        array[0, 0] = 1.0  # it is the caller's
    assert np.asarray(BALL, dtype=np.float32).dtype == np.float32
    assert np.asarray(BALL, copy=False) is BALL.heights
    with pytest.raises(ValueError, match="copy"):
        np.asarray(BALL, dtype=np.float32, copy=False)
    with pytest.raises(TypeError):
        _ = np.ones((16, 16)) + BALL


@pytest.mark.parametrize("spacing", [1e-6, (2e-6, 1e-6), np.float64(1e-6), [1e-6, 1e-6]])
def test_a_surface_takes_what_a_grid_takes_as_spacing(spacing):
    assert rc.Surface(N, spacing).grid == rc.Grid(N.shape, spacing)


def test_units_of_a_spacing_are_read():
    pint, units = pytest.importorskip("pint"), pytest.importorskip("astropy.units")
    micron = pint.get_application_registry().Quantity(1.0, "um")
    for length in (micron, 1.0 * units.um):
        assert rc.Surface(N, length).grid.spacing == pytest.approx((1e-6, 1e-6))
        assert rc.Grid((4, 8), size=8 * length).spacing == pytest.approx((1e-6, 1e-6))


@pytest.mark.parametrize("grid", ["1um", None, -1e-6, (1e-6,) * 3, RINGS, {}, np.nan])
def test_what_is_no_grid_and_no_spacing_is_refused_at_the_grid(grid):
    with pytest.raises(InputError) as caught:
        rc.Surface(N, grid)
    assert caught.value.place == "grid"


@pytest.mark.parametrize("size", [8e-6, (4e-6, 8e-6), 8])
def test_the_size_of_a_grid_is_that_of_all_cells(size):
    grid = rc.Grid((4, 8), size=size, periodic=True)
    assert grid.lengths == pytest.approx((4 / 8 * 8e-6, 8e-6) if size != 8 else (4, 8))
    assert dataclasses.replace(grid, periodic=False) == rc.Grid((4, 8), size=size)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({}, "give exactly one of spacing and size: none is given"),
        ({"spacing": 1.0, "size": 1.0}, "exactly one of spacing and size, not spacing and size"),
        ({"size": 0.0}, "size must be positive"),
        ({"size": "8um"}, "size must be positive"),
        ({"size": (1.0, 1.0, 1.0)}, "size needs one value or 2"),
    ],
)
def test_a_size_that_makes_no_sense_is_refused(given, words):
    with pytest.raises(InputError, match=words):
        rc.Grid((4, 8), **given)


# Loads of a curve.


def test_a_record_has_the_columns_of_its_curve():
    fields = [each.name for each in dataclasses.fields(rc.CurvePoint)]
    assert fields == [*names_of(CURVE[("load",)]), *names_of(FLOW)]
    assert [each.name for each in dataclasses.fields(rc.AdhesivePoint)] == [
        *names_of(ADHESIVE_CURVE[("load",)])
    ]


@pytest.mark.parametrize("curve", [CURVE_OF_BALL, LOOP.loading, STICKY], ids=["elastic", "plastic", "sticky"])
def test_a_record_holds_what_the_columns_hold(curve):
    points = list(curve)
    assert len(points) == len(curve) == len(curve.force)
    for name in (each.name for each in dataclasses.fields(points[0])):
        column = getattr(curve, name, None) if not hasattr(getattr(curve, "flow", None), name) else None
        column = getattr(curve.flow, name) if column is None and getattr(curve, "flow", None) else column
        assert [getattr(point, name) for point in points] == (
            [None] * len(points) if column is None else list(column)
        )
    assert curve[-1] == points[-1] == curve[np.int64(len(curve) - 1)]
    assert type(points[0].force) is float
    with pytest.raises(IndexError):
        curve[len(curve)]
    for wrong in (slice(2), 1.0, "force"):
        with pytest.raises(TypeError):
            curve[wrong]


def test_a_loop_is_gone_through_in_the_order_of_its_loads():
    assert [point.force for point in LOOP] == [
        force for curve in LOOP.curves.values() for force in curve.force.tolist()
    ]


# Values are values.

SETTINGS = [
    lambda: rc.Solid(210e9, 0.3),
    lambda: rc.handbook("gold"),
    lambda: dataclasses.replace(rc.handbook("gold"), hardness=1e9),
    lambda: rc.Grid((4, 8), 1e-6, periodic=(True, False)),
    lambda: rc.RadialGrid.uniform(4, 1e-3),
    lambda: rc.Adhesion(work=0.05, range=2e-9),
    lambda: rc.Adhesion(work=np.full((2, 2), 0.05), range=2e-9, law="dugdale"),
    lambda: Loads("force", np.array([1.0, 2.0])),
    lambda: rc.Force(1.0),
    lambda: rc.Depth(1.0),
    lambda: rc.Instrument("AFM", tip_radius=2e-8, noise=rc.Noise(1e-9)),
    lambda: rc.ActiveSet(max_steps=7),
    lambda: rc.PolonskyKeer(max_steps=7),
    lambda: rc.NixGao(1e9, 1e-6),
    lambda: rc.Moments(1e-12, 0.005, 1e9),
    lambda: rc.SelfAffineSpectrum(0.8, 1e-5, None, 1e-6),
    lambda: rc.StretchedSpectrum(rc.SelfAffineSpectrum(0.8, 1e-5, None, 1e-6), ratio=2.0),
    lambda: CURVE_OF_BALL[0],
]


@pytest.mark.parametrize("make", SETTINGS, ids=lambda make: type(make()).__name__)
def test_equal_settings_are_equal_and_travel(make):
    one, other = make(), make()
    assert one == other
    assert hash(one) == hash(other)
    for again in (pickle.loads(pickle.dumps(one)), copy.copy(one), copy.deepcopy(one)):
        assert again == one
        assert hash(again) == hash(one)
    assert one != object()
    for name in ("work", "values", "hurst", "hardness", "max_steps", "periodic", "young_modulus", "value"):
        if hasattr(one, name) and not isinstance(getattr(one, name), tuple):
            assert dataclasses.replace(one, **{name: getattr(one, name) * 2}) != one


def test_each_frozen_class_of_the_face_compares_by_value_or_holds_fields():
    """Classes that hold arrays of an answer are compared by identity, as arrays have no one truth."""
    shown = {type(make()).__name__ for make in SETTINGS}
    for public in public_names.public_names():
        kind = public.value
        if public.path.count(".") != 1 or not dataclasses.is_dataclass(kind):
            continue
        by_value = kind.__eq__ is not object.__eq__
        holds = any(
            "Array" in str(each.type) or "Curve" in str(each.type) for each in dataclasses.fields(kind)
        )
        assert by_value or holds or kind.__name__ in ANSWERS, kind
        assert not by_value or kind.__hash__ is not None
    assert {"Adhesion", "Grid", "Material", "ActiveSet"} <= shown


ANSWERS = {
    "Sensitivity",
    "DifferentiableCurve",
    "TangentialSolution",
    "ContactProblem",
    "TangentialStiffness",
    "Displacement",
    "Stress",
    "Comparison",
    "ContactFlux",
    "SealingLoad",
    "ShearLaw",
    "Transmissivity",
    "Joint",
    "LineSpectra",
    "Measurement",
    "Measurements",
    "JointInference",
}


def test_a_material_is_shown_in_a_line_and_its_sources_cannot_be_changed():
    assert "sources" not in repr(STEEL)
    with pytest.raises(TypeError):
        STEEL.sources["hardness"] = "hearsay"
    assert rc.handbook("Gold") is rc.handbook("gold")


@pytest.mark.parametrize("body", [1e11, None, ("steel",), 3])
def test_what_is_no_body_has_no_modulus(body):
    with pytest.raises(InputError):
        rc.reduced_modulus(body if body is not None else 0.0)
    with pytest.raises(InputError):
        rc.reduced_shear_modulus(body if body is not None else 0.0, "steel")
