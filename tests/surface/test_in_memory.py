"""Heights of other libraries in everything that looks at a surface: an answer as of NumPy's, or an error in words."""

import numpy as np
import pytest

import roughcontact as rc
from libraries import LIBRARIES, Strict, without_torch

GRID = rc.Grid((72, 80), 1e-6, periodic=True)
LINE = rc.Grid(256, 1e-6)
PLANE = rc.self_affine(GRID, 0.8, 1e-7, rng=1, rolloff=3e-5)
STICKY = rc.Adhesion(work=0.05, range=2e-8)
PROFILE = rc.self_affine(LINE, 0.8, 1e-7, rng=2)

ANALYSES = {
    "areal_parameters": lambda plane, line: rc.areal_parameters(plane),
    "surface_moments": lambda plane, line: rc.surface_moments(plane),
    "differences": lambda plane, line: rc.surface_moments(surface=plane, derivative="difference"),
    "hurst_exponent": lambda plane, line: rc.hurst_exponent(plane),
    "profile_parameters": lambda plane, line: rc.profile_parameters(line),
    "material_ratio": lambda plane, line: rc.material_ratio(plane),
    "stratified_parameters": lambda plane, line: rc.stratified_parameters(plane),
    "power_spectrum": lambda plane, line: rc.power_spectrum(plane),
    "power_spectrum of cuts": lambda plane, line: rc.power_spectrum(plane, "x"),
    "power_map": lambda plane, line: rc.power_map(plane),
    "autocorrelation": lambda plane, line: rc.autocorrelation(plane),
    "structure_function": lambda plane, line: rc.structure_function(plane),
    "structure_profile": lambda plane, line: rc.structure_profile(plane, "y"),
    "fit_structure": lambda plane, line: rc.fit_structure(plane),
    "find_summits": lambda plane, line: rc.find_summits(plane),
    "find_spikes": lambda plane, line: rc.find_spikes(plane),
    "height_histogram": lambda plane, line: rc.height_histogram(plane),
    "box_counting_dimension": lambda plane, line: rc.box_counting_dimension(plane),
    "shift_between": lambda plane, line: rc.shift_between(plane, plane).correlation,
    "loading_laws": lambda plane, line: rc.loading_laws(plane, 1e9, "gw")[0].predict("stiffness", 1e-3),
    "scan_spectrum": lambda plane, line: rc.mdr.line_scan.scan_spectrum(line)(np.array([1e5, 1e6])),
    "adhesive_state": lambda plane, line: rc.adhesive_state(plane, 1e9, STICKY, depth=1e-8).force,
    "adhesive_curve": lambda plane, line: rc.adhesive_curve(plane, 1e9, STICKY, depths=[1e-8]).force,
    "to_dataset": lambda plane, line: plane.to_dataset()["heights"].to_numpy(),
    "plot": lambda plane, line: (plane.plot().get_xlabel(), line.plot().get_ylabel()),
    "height_map": lambda plane, line: rc.plot.height_map(plane).get_xlabel(),
    "height_distribution": lambda plane, line: rc.plot.height_distribution(plane).get_xlabel(),
    "surface_view": lambda plane, line: rc.plot.surface_view(plane).get_zlabel(),
    "profile_curve": lambda plane, line: rc.plot.profile_curve(line).get_ylabel(),
}
BOTH_LIVE_THERE = {
    "combined": lambda plane: rc.combined(plane, PLANE),
    "combined, the upper": lambda plane: rc.combined(PLANE, upper=plane),
    "resampled": lambda plane: rc.resampled(plane, rc.Grid((36, 40), 2e-6, periodic=True)),
    "levelled": lambda plane: plane.levelled("plane"),
}


def there(surface, library, dtype="float64"):
    return rc.Surface(library.put(surface.heights.copy(), dtype), surface.grid)


def same(one, other):
    if hasattr(one, "__dataclass_fields__"):
        for name in one.__dataclass_fields__:
            same(getattr(one, name), getattr(other, name))
    elif isinstance(one, tuple):
        assert len(one) == len(other)
        for part, its in zip(one, other, strict=True):
            same(part, its)
    elif isinstance(one, np.ndarray):
        assert isinstance(other, np.ndarray)
        np.testing.assert_array_equal(other, one)
    elif not callable(one):
        assert one == other or (one != one and other != other)


@pytest.mark.parametrize("library", LIBRARIES)
@pytest.mark.parametrize("name", ANALYSES)
def test_an_analysis_is_that_of_heights_in_memory(name, library):
    analyse = ANALYSES[name]
    same(analyse(PLANE, PROFILE), analyse(there(PLANE, library), there(PROFILE, library)))


@pytest.mark.parametrize("library", LIBRARIES)
@pytest.mark.parametrize("name", BOTH_LIVE_THERE)
def test_what_gives_a_surface_back_is_refused_in_words(name, library):
    with pytest.raises(ValueError, match=r"in NumPy's memory, not a .*: prepare the surface first"):
        BOTH_LIVE_THERE[name](there(PLANE, library))


def test_heights_in_slabs_are_refused_with_the_way_to_gather_them():
    slabs = rc.Slabs()
    plane = rc.Surface(slabs.array(PLANE.heights), GRID)
    with pytest.raises(ValueError, match=r"rc\.Surface\(surface\.heights\.gathered\(\), surface\.grid\)"):
        rc.areal_parameters(plane)
    gathered = rc.Surface(plane.heights.gathered(), plane.grid)
    assert rc.areal_parameters(gathered) == rc.areal_parameters(PLANE)


def test_single_precision_is_analysed_in_double():
    found = rc.areal_parameters(there(PLANE, Strict, "float32"))
    # Rounded by half of 2^-23 of each height.
    assert found.Sq == pytest.approx(rc.areal_parameters(PLANE).Sq, rel=2**-23)


@without_torch
def test_a_precision_that_numpy_does_not_know():
    import torch

    plane = rc.Surface(torch.as_tensor(PLANE.heights.copy()).to(torch.bfloat16), GRID)
    assert rc.surface_moments(plane).rms_height == pytest.approx(PLANE.rms, rel=2**-8)  # eight bits
