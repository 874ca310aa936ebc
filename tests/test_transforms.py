"""Products with even kernels: fields of any library and precision, by whatever does them, have the same answer."""

import copy
import gc
import pickle

import numpy as np
import pytest
from hypothesis import given, strategies as st

from libraries import LIBRARIES
from roughcontact import transforms
from roughcontact.kernels import loader as machine
from roughcontact.transforms import FEWEST_ROWS, Convolution, convolve, even_multiplier, padded_length

SIZES = {  # shape and lengths
    "padded": ((20, 33), (40, 64)),
    "not padded": ((24, 30), (24, 30)),
    "padded along one axis": ((24, 17), (24, 36)),
    "as few rows as there may be": ((FEWEST_ROWS, 9), (16, 16)),
    "too few rows": ((FEWEST_ROWS - 1, 40), (12, 80)),
    "one row": ((1, 40), (2, 80)),
    "odd rows": ((20, 21), (20, 21)),
    "odd columns": ((21, 20), (21, 20)),
    "a prime factor of seven": ((28, 20), (28, 40)),
}
IN_MACHINE_CODE = {"padded", "not padded", "padded along one axis", "as few rows as there may be"}
PRECISIONS = ("float32", "float64")

needs_machine_code = pytest.mark.skipif(not machine.is_available(), reason="no machine code here")


@pytest.fixture(params=SIZES)
def size(request):
    return SIZES[request.param]


def multiplier_of(lengths):
    """Return a real transform of some even kernel, all of it of size one or so."""
    rng = np.random.default_rng(5)
    return rng.uniform(0.1, 1.0, tuple(n // 2 + 1 for n in lengths))


def noise(shape, seed=1):
    return np.random.default_rng(seed).standard_normal(shape)


def close(found, exact, precision="float64"):
    """Equal up to the rounding of transforms: some ten units in the last place of the norm, the kernel being of one."""
    atol = 10 * np.finfo(precision).eps * np.linalg.norm(exact)
    np.testing.assert_allclose(np.asarray(found), exact, rtol=0, atol=atol)


@pytest.fixture
def by_whom(monkeypatch):
    """Return a list of what did the products, one after the other."""
    done = []

    def plain(*given):
        done.append("library")
        return convolve(*given)

    monkeypatch.setattr(transforms, "convolve", plain)
    if machine.is_available():
        from roughcontact.kernels.compiled_convolution import CompiledConvolution as Ready

        compiled = Ready.apply

        def apply(self, plane):
            done.append("machine code")
            return compiled(self, plane)

        monkeypatch.setattr(Ready, "apply", apply)
    return done


@pytest.mark.parametrize("precision", PRECISIONS)
def test_the_same_as_by_transforms_of_scipy(size, precision):
    shape, lengths = size
    multiplier, field = multiplier_of(lengths), noise(shape).astype(precision)
    found = Convolution(multiplier.copy(), lengths).apply(field)
    assert found.dtype == precision
    close(found, convolve(field.astype(np.float64), multiplier, lengths), precision)


@pytest.mark.parametrize("library", LIBRARIES, ids=lambda kind: kind.__name__)
@pytest.mark.parametrize("precision", PRECISIONS)
def test_the_same_for_other_libraries(library, precision, size):
    shape, lengths = size
    multiplier, field = multiplier_of(lengths), noise(shape)
    exact = convolve(field, multiplier, lengths)
    product = Convolution(multiplier.copy(), lengths)
    product.apply(field)  # NumPy's turn before: the kernel is not lost to others
    found = product.apply(library.put(field.copy(), precision))
    assert library.is_there(found)
    assert str(found.dtype).endswith(precision)
    close(library.get(found), exact, precision)
    close(product.apply(field), exact)


@pytest.mark.parametrize("order", [("float64", "float32"), ("float32", "float64", "float32")], ids=str)
def test_precisions_in_any_order(size, order):
    shape, lengths = size
    multiplier, field = multiplier_of(lengths), noise(shape)
    exact = convolve(field, multiplier, lengths)
    product = Convolution(multiplier.copy(), lengths)
    for precision in order:
        found = product.apply(field.astype(precision))
        assert found.dtype == precision
        close(found, exact, precision)


def test_shapes_in_any_order():
    """One kernel for all that its lengths have room for."""
    lengths = (40, 60)
    multiplier = multiplier_of(lengths)
    product = Convolution(multiplier.copy(), lengths)
    for shape in ((20, 30), (40, 60), (8, 3), (7, 50), (20, 30)):
        for precision in ("float64", "float32"):
            field = noise(shape).astype(precision)
            exact = convolve(field.astype(np.float64), multiplier, lengths)
            close(product.apply(field), exact, precision)


@pytest.mark.parametrize("kind", [np.int64, np.int32, np.uint8, np.int8, bool])
def test_whole_numbers_and_truth_values(size, kind):
    shape, lengths = size
    field = (np.arange(np.prod(shape)).reshape(shape) % 3).astype(kind)
    product = Convolution(multiplier_of(lengths), lengths)
    found = product.apply(field)
    assert found.dtype == np.float64
    np.testing.assert_array_equal(found, product.apply(field.astype(np.float64)))


@pytest.mark.parametrize("kind", [">f8", "<f8", ">f4", "<f4", ">i4", "<i4"])
def test_numbers_of_either_byte_order(size, kind):
    shape, lengths = size
    field = np.rint(10 * noise(shape))
    product = Convolution(multiplier_of(lengths), lengths)
    precision = "float32" if "f4" in kind else "float64"
    close(product.apply(field.astype(kind)), product.apply(field), precision)


def test_fields_that_lie_otherwise_in_memory(size):
    shape, lengths = size
    field, product = noise(shape), Convolution(multiplier_of(lengths), lengths)
    wanted = product.apply(field)
    wide = np.zeros((shape[0], 2 * shape[1]))
    wide[:, ::2] = field
    for same in (np.asfortranarray(field), wide[:, ::2]):
        close(product.apply(same), wanted)


@needs_machine_code
@pytest.mark.parametrize("name", SIZES)
def test_who_does_what(name, by_whom):
    shape, lengths = SIZES[name]
    product = Convolution(multiplier_of(lengths), lengths)
    for precision in PRECISIONS:
        product.apply(noise(shape).astype(precision))
    assert by_whom == 2 * ["machine code" if name in IN_MACHINE_CODE else "library"]


@needs_machine_code
def test_no_kernel_is_kept_twice():
    """After a product of double precision the machine code's own copy is the only one."""
    lengths = (40, 64)
    multiplier = multiplier_of(lengths)
    product = Convolution(multiplier, lengths)
    assert product._kernel() is multiplier
    product.apply(noise((20, 33)).astype(np.float32))
    assert product._kernel() is multiplier
    product.apply(noise((20, 33)))
    assert product._kernel() is not multiplier
    np.testing.assert_allclose(product._kernel(), multiplier, rtol=1e-15)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_without_machine_code(size, precision, by_whom, monkeypatch):
    monkeypatch.setattr(machine, "is_available", lambda: False)
    shape, lengths = size
    multiplier, field = multiplier_of(lengths), noise(shape).astype(precision)
    found = Convolution(multiplier, lengths).apply(field)
    assert by_whom == ["library"]
    assert found.dtype == precision
    close(found, transforms.convolve(field.astype(np.float64), multiplier, lengths), precision)


@given(st.integers(1, 100_000))
def test_padded_lengths(cells):
    length = padded_length(cells)
    assert length % 2 == 0
    assert length >= 2 * cells - 2
    assert cells < FEWEST_ROWS or length % 8 == 0
    for factor in (2, 3, 5):
        while length % factor == 0:
            length //= factor
    assert length == 1


@pytest.mark.parametrize("cells", [*range(1, 70), 512, 513, 1000, 1024, 1025])
def test_padded_lengths_are_short(cells):
    """The next one above, of those that are even, or of eights."""
    least, step = max(2, 2 * cells - 2), 2 if cells < FEWEST_ROWS else 8
    smooth = (n for n in range(least + -least % step, 4 * least, step) if _smooth(n))
    assert padded_length(cells) == next(smooth)


def _smooth(n):
    for factor in (2, 3, 5):
        while n % factor == 0:
            n //= factor
    return n == 1


@pytest.mark.parametrize("shape", [(9, 17), (3, 12), (33, 8)])
def test_offsets_to_both_ends_may_share_a_place(shape):
    """With no more room than that, nothing comes round: loads in corners meet at the largest offset only."""
    lengths = tuple(padded_length(n) for n in shape)
    y, x = np.indices(shape)
    table = 1.0 / (1 + y + 2 * x)
    product = Convolution(even_multiplier(table, lengths), lengths)
    for rows, columns in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        field = np.zeros(shape)
        field[(rows - 1) // 2, (columns - 1) // 2] = 1.0
        close(product.apply(field)[::rows, ::columns], table)


def used(precision="float64"):
    """A convolution that has done a product, and its field and answer."""
    field = np.random.default_rng(0).random((20, 24)).astype(precision)
    convolution = Convolution(np.random.default_rng(1).random((21, 25)), (40, 48))
    return convolution, field, convolution.apply(field)


@pytest.mark.parametrize("precision", ["float64", "float32"])
@pytest.mark.parametrize("copied", [copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))])
def test_copies_outlive_what_they_were_made_of(copied, precision):
    convolution, field, answer = used(precision)
    other = copied(convolution)
    del convolution
    gc.collect()
    np.testing.assert_array_equal(other.apply(field), answer)


@needs_machine_code
@pytest.mark.parametrize("shape", [(41, 24), (20, 49), (100, 100)])
def test_a_field_larger_than_the_transforms_is_refused(shape):
    with pytest.raises(ValueError, match="larger than transforms"):
        used()[0].apply(np.ones(shape))
