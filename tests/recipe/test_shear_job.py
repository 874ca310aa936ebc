"""The job of an interface under shear: the pressures of its normal curve, and the calls of its parts."""

import numpy as np
import pytest

from roughcontact.recipe.job_calls import python_of
from roughcontact.recipe.jobs import calls_of
from roughcontact.recipe.written import from_plain


def made(shear, **parts):
    plain = {"job": "shear", "source": {"file": "part.npz"}, "bodies": {"materials": "steel,steel"}}
    return from_plain(plain | {"shear": {"friction": "0.2"} | shear} | parts)


@pytest.mark.parametrize("pressures", ["10MPa", "1MPa:30MPa:6", "1MPa,1.0005MPa,32MPa", "3Pa"])
@pytest.mark.parametrize("amplitude", ["0.5", "0.1,0.3,0.5,0.8", "0.9999", "1"])
def test_the_normal_curve_has_all_pressures_that_the_law_is_asked_for(pressures, amplitude):
    job = made({"pressures": pressures, "amplitude": amplitude})
    loads = np.array(job.curve_pressures())
    assert (np.diff(loads) > 0).all()
    named = next(call.given[1] for call in job.calls() if call.result == "shear")
    assert set(named) <= set(loads.tolist())
    assert loads[-1] == named[-1]
    shares = [float(each) for each in amplitude.split(",")]
    # Other loads are rounded to nine digits, and left out within a thousandth of one that is there.
    for p in named:
        for share in shares:
            for held in (p * (1 - share / 2), p * (1 - share)):
                assert held == 0 or abs(loads / held - 1).min() <= 1e-3 or held < loads[0]
    # Free maps: no p - tau/mu lies below the lowest load, except at gross slip.
    assert shares[-1] == 1 or named[0] * (1 - shares[-1]) > loads[0]
    assert loads[0] <= 0.01 * named[0]
    # Ten a decade: neighbours differ by a factor of 10^(1/10) at most, and by a part in a thousand at least, except
    # where the user has named both.
    ratios = loads[1:] / loads[:-1]
    assert ratios.max() <= 10**0.1 * (1 + 1e-8)
    given = np.isin(loads[1:], named) & np.isin(loads[:-1], named)
    assert (ratios[~given] > 1 + 0.9e-3).all()


def test_thousands_of_pressures_take_no_longer_than_they_need():
    assert len(made({"pressures": "1MPa:30MPa:20000"}).curve_pressures()) > 20000


def test_after_flow_the_loop_goes_up_to_the_larger_load():
    job = made({"pressures": "10MPa"}, plastic={"after": "50MPa"})
    loop, law, table = job.calls()
    assert (loop.function, loop.named["pressures"][-1]) == ("rc.loading_loop", 50e6)
    assert str(loop.named["hardness"]) == 'rc.handbook("steel").hardness'
    assert str(law) == 'law = rc.shear_law(loop, ("steel", "steel"), friction=0.2)'
    assert str(table) == "shear = rc.shear_dataset(law, [10000000.0], [0.5])"
    job = made({"pressures": "10MPa"}, plastic={"hardness": "1GPa", "flow": "raised"})
    loop, *_ = job.calls()
    assert (loop.named["flow"], loop.named["hardness"], loop.named["pressures"][-1]) == ("raised", 1e9, 1e7)


def test_partial_slip_is_computed_at_the_largest_pressure_on_the_surface_that_is_left():
    shear = {"pressures": "1MPa,10MPa", "amplitude": "0.25,0.5", "shear_strength": "300MPa", "compute": True}
    *_, solution, cycles, table = map(str, made(shear).calls())
    assert solution == "*_, solution = rc.loading_path(surface, modulus, pressures=[10000000.0])"
    cycle = 'rc.shear_cycle(solution, ("steel", "steel"), friction=0.2, shear_strength=300000000.0, traction='
    assert cycles == f"cycles = [{cycle}500000.0), {cycle}1000000.0)]"
    assert table.endswith("[0.25, 0.5], cycles=cycles)")
    *_, solution, _, _ = made(shear, plastic={"hardness": "1GPa"}).calls()
    assert str(solution).startswith("*_, solution = rc.loading_path(loop.flattened, modulus")


def test_one_body_may_be_rigid():
    one = made({"pressures": "1MPa"}, bodies={"young": "1GPa", "poisson": "0.3"})
    assert "law = rc.shear_law(curve, rc.Solid(1000000000.0, 0.3), friction=0.2)" in python_of(calls_of(one))
