"""Files of surfaces and solutions in slabs: those of one process, whatever the number of processes."""

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.files.provenance import surface_hash
from roughcontact.slabs import by_rows
from slabs.together import together

SIZES = [1, 2, 3, 4]


@pytest.fixture(params=["at once", "in turns"])
def turns(request, monkeypatch):
    if request.param == "in turns":
        monkeypatch.setattr(by_rows, "AT_ONCE", 50)  # a row or two of the planes below


def rough(shape=(30, 24)):
    grid = rc.Grid(shape, (1e-6, 1.5e-6), periodic=True)
    return rc.self_affine(grid, hurst=0.8, rms=1e-7, rolloff=1e-5, rng=np.random.default_rng(1))


def in_slabs(surface, communicator):
    slabs = rc.Slabs(communicator)
    rows = slabs.rows(surface.grid.shape[0])
    return rc.Surface(slabs.array(surface.heights[rows]), surface.grid, surface.provenance)


@pytest.mark.parametrize("beside", ["axes", "points", "list"])
def test_what_is_beside_heights_is_left_to_one_process(beside, tmp_path):
    heights = rough((12, 12)).heights * 1e6
    y, x = np.indices(heights.shape) * 0.5
    lists = {
        "points": np.c_[x.ravel(), y.ravel(), heights.ravel()],
        "list": np.c_[x.ravel(), heights.ravel()],
    }
    np.save(tmp_path / "map.npy", lists.get(beside, np.vstack([x[0], heights])))

    def work(communicator):
        with pytest.raises(rc.ReadError, match=r"read it by one process|look like places and heights"):
            rc.read(tmp_path / "map.npy", unit="um", size="6 um", slabs=rc.Slabs(communicator))

    together(2, work)
    if beside != "list":
        with pytest.warns(rc.SurfaceWarning, match="places, not heights|points x, y, z"):
            whole = rc.read(tmp_path / "map.npy", unit="um", size="6 um")
        np.testing.assert_array_equal(whole.heights, heights * 1e-6)


@pytest.mark.usefixtures("turns")
@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("name", ["map.npy", "map.nc", "map.npz"])
def test_a_file_is_read_as_by_one_process(size, name, tmp_path):
    surface, path = rough(), tmp_path / name
    rc.write(surface, path)
    stated = {"unit": "m", "size": surface.grid.lengths, "periodic": True} if name == "map.npy" else {}
    whole = rc.read(path, **stated)

    def work(communicator):
        there = rc.read(path, **stated, slabs=rc.Slabs(communicator))
        return there.heights.gathered(), there.grid, there.provenance, surface_hash(there)

    for heights, grid, provenance, digest in together(size, work):
        np.testing.assert_array_equal(heights, whole.heights)
        assert (grid, provenance, digest) == (whole.grid, whole.provenance, surface_hash(whole))


def test_what_one_process_warns_of_is_warned_of_here(tmp_path):
    heights = np.random.default_rng(1).standard_normal((40, 40)) * 1e-7
    rc.write(rc.Surface(heights, rc.Grid((40, 40), 1e-6)), tmp_path / "map.npz")
    with pytest.warns(rc.SurfaceWarning):
        whole = rc.read(tmp_path / "map.npz")

    with pytest.warns(rc.SurfaceWarning, match="random|noise"):
        [there] = together(1, lambda one: rc.read(tmp_path / "map.npz", slabs=rc.Slabs(one)))
    assert there.provenance == whole.provenance


@pytest.mark.parametrize("order", ["C", "F"])
def test_numbers_of_any_type_and_order(order, tmp_path):
    numbers = np.arange(20, dtype=">i2").reshape(5, 4, order=order)
    np.save(tmp_path / "map.npy", numbers)

    def work(communicator):
        there = rc.read(tmp_path / "map.npy", unit="nm", size=1e-6, slabs=rc.Slabs(communicator))
        return there.heights.gathered()

    for heights in together(3, work):
        np.testing.assert_array_equal(heights, numbers * 1e-9)


@pytest.mark.usefixtures("turns")
@pytest.mark.parametrize("size", SIZES)
def test_heights_are_one_file(size, tmp_path):
    """That of ``.npy`` to the last byte."""
    surface = rough()
    for name in ("here.npy", "here.nc"):
        rc.write(surface, tmp_path / name)

    def work(communicator):
        for name in ("there.npy", "there.nc"):
            rc.write(in_slabs(surface, communicator), tmp_path / name)

    together(size, work)
    assert (tmp_path / "there.npy").read_bytes() == (tmp_path / "here.npy").read_bytes()
    here, there = (rc.read(tmp_path / f"{place}.nc") for place in ("here", "there"))
    np.testing.assert_array_equal(there.heights, here.heights)
    assert (there.grid, there.provenance[:-1]) == (here.grid, here.provenance[:-1])  # the last names the file
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(
        ("here.npy", "here.nc", "there.npy", "there.nc")
    )


LOAD = {"pressure": 1e6, "tolerance": 1e-12}


@pytest.fixture(scope="module")
def of_one_process(tmp_path_factory):
    """A solution and its file."""
    solution, path = rc.press(rough((64, 48)), 1e9, **LOAD), tmp_path_factory.mktemp("one") / "here.nc"
    rc.write(solution, path)
    return solution, path


@pytest.mark.parametrize("size", SIZES)
def test_a_solution_is_the_file_of_one_process(size, of_one_process, tmp_path, monkeypatch):
    """To what `test_slabs.test_press` allows; variables, attributes and storage to the letter, written either way."""
    here, path = of_one_process
    surface = rough((64, 48))

    def work(communicator):
        solution = rc.press(in_slabs(surface, communicator), 1e9, **LOAD)
        rc.write(solution, tmp_path / "at once.nc")
        communicator.allgather(None)  # all have written
        monkeypatch.setattr(by_rows, "AT_ONCE", 50)
        communicator.allgather(None)
        rc.write(solution, tmp_path / "in turns.nc")
        return solution.to_record()

    records = together(size, work)
    assert records[0].keys() == here.to_record().keys()
    assert all(record == records[0] for record in records)
    for name in ("at once.nc", "in turns.nc"):
        compare(path, tmp_path / name, here)


def compare(path, there, here):
    with xarray.open_dataset(path) as one, xarray.open_dataset(there) as other:
        assert set(one.variables) == set(other.variables)
        own = ("date_created",)
        assert {k: v for k, v in one.attrs.items() if k not in own} == {
            k: v for k, v in other.attrs.items() if k not in own
        }
        for name, values in one.variables.items():
            found = other[name].variable
            assert (found.dims, found.dtype, found.attrs) == (values.dims, values.dtype, values.attrs), name
            kept = {"zlib", "complevel", "shuffle", "_FillValue"}
            storage = ({key: str(v.encoding.get(key)) for key in kept} for v in (values, found))
            assert next(storage) == next(storage), name
            if values.dtype.kind == "f" and name not in ("residual", "stiffness_residual"):
                scale = np.abs(values).max() if values.size else 0.0
                atol = 1e-9 * float(max(scale, here.depth if name == "gap" else 0.0))
                np.testing.assert_allclose(found, values, rtol=0, atol=atol, err_msg=name)
            elif values.dtype.kind in "ib" and name != "steps":
                np.testing.assert_array_equal(found, values, err_msg=name)


def test_what_goes_wrong_on_one_process_is_raised_on_all(tmp_path):
    (tmp_path / "map.npy").write_bytes(b"\x93NUMPY no")
    np.save(tmp_path / "cut.npy", np.zeros((4, 4)))
    (tmp_path / "cut.npy").write_bytes((tmp_path / "cut.npy").read_bytes()[:-8])
    np.save(tmp_path / "line.npy", np.zeros(4))
    np.save(tmp_path / "words.npy", np.full((4, 4), "a"))
    surface = rough()

    def attempt(name, act):
        def work(communicator):
            try:
                act(rc.Slabs(communicator), tmp_path / name, communicator)
            except ValueError as error:
                return str(error)

        return work

    def read(slabs, path, _):
        rc.read(path, unit="m", size=1.0, slabs=slabs)

    def write(_, path, communicator):
        rc.write(in_slabs(surface, communicator), path)

    for name, act, words in [
        ("none.npy", read, "none.npy: it cannot be opened (No such file"),
        ("none.npz", read, "none.npz: it cannot be opened (No such file"),
        ("map.npy", read, "not a whole NumPy array"),
        ("cut.npy", read, "it holds 248 of 256 bytes"),
        ("line.npy", read, "a profile of 4 heights"),
        ("words.npy", read, "values are of type <U1"),
        ("no/map.npy", write, "there is no folder"),
        ("no/map.nc", write, "there is no folder"),
        ("map.x3p", write, "a Surface in slabs is written as one of .npy, .nc"),
    ]:
        told = together(2, attempt(name, act))
        assert told[0] == told[1], name
        assert words in told[0], (name, told)


def test_a_writer_that_fails_leaves_nothing(tmp_path, monkeypatch):
    """The disk is full for one of them."""
    surface = rough()
    real = open

    def full(path, mode="r", *rest, **named):
        if mode == "r+b":
            raise OSError(28, "No space left on device")
        return real(path, mode, *rest, **named)

    monkeypatch.setattr("roughcontact.files.numpy_files.open", full, raising=False)
    with pytest.raises((rc.WriteError, OSError), match="No space left"):
        together(2, lambda communicator: rc.write(in_slabs(surface, communicator), tmp_path / "map.npy"))
    assert list(tmp_path.iterdir()) == []
