"""Paths of surfaces that stick written, and read back to the last bit."""

import dataclasses
import functools

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.files.write import write_netcdf
from sticking import rough, sticky

RINGS = rc.RadialGrid.uniform(30, radius=6e-7)
BALL = rc.RadialProfile(-(RINGS.radii**2) / 2e-5, RINGS)
STRONG = rc.Adhesion(work=10e-3, range=4e-9, allow_unresolved=True)


def patchy():
    """A law whose work differs from cell to cell, on a periodic grid with other sides than cells."""
    surface, law = rough(16, periodic=True, slope=0.2, seed=1), sticky(2.0)
    work = np.full((16, 16), law.work)
    work[3:7] = 0.0
    return rc.adhesive_curve(surface, 1.0, rc.Adhesion(work, law.range), depths=[0.1, 0.0])


def on_a_line():
    grid = rc.Grid(32, 1.0, periodic=True)
    line = rc.Surface(np.cos(2 * np.pi * np.arange(32) / 32), grid)
    return rc.adhesive_curve(line, 1.0, sticky(4.0), depths=[0.1, 0.3, 0.1], operator=rc.line(grid, 1.0))


LOOPS = {
    "rings": lambda: rc.adhesive_loop(BALL, 1e8, STRONG, depth=10e-9, points=6),
    # Pulled off: a depth of minus infinity, a jump to no depth, infinite loss.
    "forces": lambda: rc.adhesive_curve(BALL, 1e8, STRONG, forces=[0.0, 4e-7, -1e-6, 0.0]),
    "no jump": lambda: rc.adhesive_curve(BALL, 1e8, STRONG, depths=[-30e-9]),
    "patchy": patchy,
    "line": on_a_line,
}
LOOPS = {name: functools.cache(loop) for name, loop in LOOPS.items()}


@pytest.mark.parametrize("name", LOOPS)
def test_every_path_comes_back_to_the_last_bit(tmp_path, name):
    loop = LOOPS[name]()
    rc.write(loop, tmp_path / "a.nc")
    back = rc.read_adhesive_curve(tmp_path / "a.nc")
    for field in dataclasses.fields(loop):
        went, came = getattr(loop, field.name), getattr(back, field.name)
        assert type(came) is type(went), field.name
        if isinstance(went, np.ndarray):
            assert came.dtype == went.dtype, field.name
            assert came.tobytes() == went.tobytes(), field.name
        elif field.name == "adhesion":
            np.testing.assert_array_equal(came.work, went.work)
            assert (
                dataclasses.replace(came, work=1.0).__repr__()
                == dataclasses.replace(went, work=1.0).__repr__()
            )
        elif field.name == "jumps":  # some hold a NaN, which equals nothing
            assert [str(jump) for jump in came] == [str(jump) for jump in went]
        else:
            assert came == went, field.name
    assert back.to_record() == loop.to_record()


def test_these_paths_hold_what_is_hard_to_write():
    """Else the test above would say nothing of it."""
    forces = LOOPS["forces"]()
    assert forces.control == "force"
    assert np.isneginf(forces.depth).any()
    assert any(np.isinf(jump.lost) and np.isnan(jump.depth_after) for jump in forces.jumps)
    assert not LOOPS["no jump"]().jumps
    assert np.ndim(LOOPS["patchy"]().adhesion.work) == 2
    assert not LOOPS["rings"]().approach.all()


def test_what_holds_no_such_path_is_refused(tmp_path):
    ball = rc.shapes.paraboloid(rc.Grid((16, 16), 1e-6), radius=1e-4)
    rc.write(rc.loading_curve(ball, 1e9, forces=[1e-3, 2e-3]), tmp_path / "curve.nc")
    with pytest.raises(rc.ReadError, match="do not stick; read it with read_curve"):
        rc.read_adhesive_curve(tmp_path / "curve.nc")
    rc.write(LOOPS["no jump"](), tmp_path / "loop.nc")
    with pytest.raises(rc.ReadError, match="that stick; read it with read_adhesive_curve"):
        rc.read_curve(tmp_path / "loop.nc")
    rc.write(LOOPS["no jump"](), tmp_path / "loop.csv")
    with pytest.raises(rc.ReadError, match=r"NetCDF files \(\.nc\) only"):
        rc.read_adhesive_curve(tmp_path / "loop.csv")
    rc.write(ball, tmp_path / "ball.nc")
    with pytest.raises(rc.ReadError, match="holds no loading curve: no depth"):
        rc.read_adhesive_curve(tmp_path / "ball.nc")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.drop_vars("jump_lost"), "no jump_lost"),
        (lambda d: d.assign_attrs(law="magnetic"), "its law of adhesion is 'magnetic'"),
        (lambda d: d.assign_attrs(geometry="cube"), "its geometry is 'cube'"),
        (lambda d: d.assign(adhesion_range=-1.0), "range of the attraction"),
        (
            lambda d: d.assign(branch=("load", np.repeat("sideways", d.sizes["load"]))),
            "branches are sideways",
        ),
        (lambda d: d.assign(depth=("jump", np.zeros(d.sizes["jump"]))), "its depth of shape"),
    ],
    ids=["lost", "law", "geometry", "range", "branch", "shape"],
)
def test_what_is_wrong_is_named(tmp_path, change, message):
    write_netcdf(change(LOOPS["rings"]().to_dataset()), tmp_path / "a.nc")
    with pytest.raises(rc.ReadError, match=message):
        rc.read_adhesive_curve(tmp_path / "a.nc")


def test_damage_is_a_read_error(tmp_path):
    path = tmp_path / "a.nc"
    rc.write(LOOPS["rings"](), path)
    whole = path.read_bytes()
    for spoilt in (b"", whole[:100], whole[: len(whole) // 2], bytes(len(whole))):
        path.write_bytes(spoilt)
        with pytest.raises(rc.ReadError):
            rc.read_adhesive_curve(path)
