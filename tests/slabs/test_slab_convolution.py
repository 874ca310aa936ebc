"""Convolutions of planes in slabs in machine code: those of one process to the last bit."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact import transforms
from roughcontact.kernels import convolution_steps, loader
from roughcontact.slabs import exchange
from roughcontact.slabs.rows import edges_of
from roughcontact.slabs.slab_convolution import SlabConvolution
from roughcontact.threads import limit_threads
from roughcontact.transforms import Convolution
from slabs.together import together

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

# Rows that go evenly and not, fewer rows than processes, fewer blocks of columns than processes, two blocks of 8 lanes.
SHAPES = [(64, 48), (45, 50), (12, 20), (8, 4), (10, 16)]
PRECISIONS = ("float32", "float64")


def multiplier(shape):
    return np.random.default_rng(3).uniform(0.1, 1.0, tuple(n // 2 + 1 for n in shape))


def noise(shape, precision):
    return np.random.default_rng(4).standard_normal(shape).astype(precision)


def product(communicator, field, factors):
    slabs = rc.Slabs(communicator)
    there = Convolution(factors, field.shape).apply(slabs.array(field[slabs.rows(len(field))]))
    assert there.dtype == field.dtype
    return there.gathered()


@pytest.fixture
def in_machine_code(monkeypatch):
    """Let nothing else do it."""
    monkeypatch.setattr(transforms, "filtered_in_slabs", None)


@pytest.fixture(params=["at once", "in turns"])
def turns(request, monkeypatch):
    """In one exchange of all blocks, and in one for each block of a process."""
    monkeypatch.setattr(exchange, "PARTS", 1)
    if request.param == "in turns":
        monkeypatch.setattr(exchange, "PARTS", 2**40)
        monkeypatch.setattr(exchange, "FEWEST", 1)


@pytest.mark.usefixtures("in_machine_code", "turns")
@pytest.mark.parametrize("size", [1, 2, 3, 4, 11])
@pytest.mark.parametrize("shape", SHAPES, ids=str)
@pytest.mark.parametrize("precision", PRECISIONS)
def test_the_same_as_of_one_process(size, shape, precision):
    """The kernel as a whole, and made by columns where they are wanted: never none, of which some make no kernel."""
    field, factors = noise(shape, precision), multiplier(shape)
    here = Convolution(factors, shape).apply(field)

    def some(columns):
        assert columns.stop > columns.start
        return factors[:, columns]

    for given in (factors, some):
        for there in together(size, lambda one, given=given: product(one, field, given)):
            np.testing.assert_array_equal(there, here)


@pytest.mark.usefixtures("in_machine_code")
@pytest.mark.parametrize("precision", PRECISIONS)
def test_answers_do_not_hang_on_the_number_of_threads(precision, monkeypatch):
    monkeypatch.setattr(convolution_steps, "LARGE", 0)
    shape = (200, 120)
    field, factors = noise(shape, precision), multiplier(shape)
    here = Convolution(factors, shape).apply(field)

    def work(communicator):
        with limit_threads(3):
            return product(communicator, field, factors)

    for there in together(2, work):
        np.testing.assert_array_equal(there, here)


@pytest.mark.parametrize("processes", [1, 2, 3, 7, 40])
@pytest.mark.parametrize("shape", SHAPES, ids=str)
@pytest.mark.usefixtures("turns")
def test_a_process_holds_its_share_of_the_kernel_alone(shape, processes):
    """The blocks of each differ by one at most, all together are all, and every column is asked for once."""
    asked = []

    def columns(part):
        asked.extend(range(part.start, part.stop))
        return multiplier(shape)[:, part]

    edges = edges_of(shape[0], processes)
    ready = [SlabConvolution.of(columns, shape, "float32", edges, rank) for rank in range(processes)]
    held = [sum(map(len, one.multipliers)) for one in ready]
    assert max(held) - min(held) <= 1
    assert sum(held) == ready[0].plan.blocks
    assert sorted(asked) == list(range(shape[1] // 2 + 1))


def test_where_one_process_has_no_machine_code_no_process_uses_it(monkeypatch):
    """They would wait for each other in different exchanges. Of 15 rows the processes have 7 and 8."""
    shape = (15, 20)
    field, factors = noise(shape, "float64"), multiplier(shape)
    here = Convolution(factors, shape).apply(field)
    real = loader.takes
    monkeypatch.setattr(loader, "takes", lambda rows: len(rows) != 8 and real(rows))
    monkeypatch.setattr(SlabConvolution, "apply", None)
    for there in together(2, lambda one: product(one, field, factors)):
        # As in `test_transforms`: some ten units in the last place of the norm.
        atol = 10 * np.finfo(field.dtype).eps * np.linalg.norm(here)
        np.testing.assert_allclose(there, here, rtol=0, atol=atol)


@pytest.mark.usefixtures("in_machine_code", "turns")
@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("shape", [(45, 50), (12, 20), (8, 4)], ids=str)
def test_memory_is_kept_to(precision, shape, monkeypatch):
    """All room is no numbers at first (bytes of all ones are none either), with as many before and behind."""
    field, factors = noise(shape, precision), multiplier(shape)
    here = Convolution(factors, shape).apply(field)
    rooms, margin = [], 1024

    def surrounded(shape, dtype):
        nothing = 255 if np.dtype(dtype).kind == "u" else np.nan
        size = int(np.prod(shape))
        rooms.append(np.full(size + 2 * margin, nothing, dtype))
        return rooms[-1][margin : margin + size].reshape(shape)

    def work(communicator):
        slabs = rc.Slabs(communicator)
        mine = slabs.array(field[slabs.rows(len(field))])
        return Convolution(factors, shape).apply(mine).local

    monkeypatch.setattr(np, "empty", surrounded)
    there = together(3, work)
    monkeypatch.undo()
    np.testing.assert_array_equal(np.concatenate(there), here)
    # Of each process: the spectrum, the answer, columns, and what threads work in.
    assert len(rooms) >= 3 * 3
    for numbers in rooms:
        for outside in (numbers[:margin], numbers[-margin:]):
            assert (outside == 255).all() if numbers.dtype.kind == "u" else np.isnan(outside).all()
