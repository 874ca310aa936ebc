"""Machine code for a processor by its name, for the one at hand, or none at all."""

import numpy as np
import pytest

from roughcontact.kernels import loader, processor
from roughcontact.kernels.processor import VARIABLE

binding = pytest.importorskip("llvmlite.binding")
HERE = processor._NEEDED.get(binding.get_default_triple().partition("-")[0], {})


@pytest.fixture
def asked(monkeypatch):
    """Return what sets the name that the environment asks for; the loader forgets what it found before and after."""
    caches = (loader.is_available, loader.functions, loader._target)

    def ask(name):
        if name is None:
            monkeypatch.delenv(VARIABLE, raising=False)
        else:
            monkeypatch.setenv(VARIABLE, name)
        for each in caches:
            each.cache_clear()

    yield ask
    for each in caches:
        each.cache_clear()


def on_a_machine_with(monkeypatch, *features):
    found = {name: name in features for name in processor._LEVEL_4}
    monkeypatch.setattr(binding, "get_host_cpu_features", lambda: found)


@pytest.mark.parametrize("name", [None, "", "native"])
def test_it_is_the_one_at_hand_by_default(asked, name):
    asked(name)
    features = binding.get_host_cpu_features().flatten()
    assert processor.processor() == (binding.get_host_cpu_name(), features)


@pytest.mark.parametrize("name", HERE)
def test_a_name_brings_its_own_features_and_not_those_of_the_machine(asked, monkeypatch, name):
    on_a_machine_with(monkeypatch, *HERE[name])
    asked(name)
    assert processor.processor() == (name, "")


@pytest.mark.parametrize("name", ["abacus", "i386", "Haswell", "native ", "none"])
def test_an_unknown_name_is_refused_before_llvm_ends_the_process(asked, name):
    asked(name)
    with pytest.raises(ValueError, match=f"{VARIABLE}='{name}' is not a processor known here: .*native, off"):
        loader.is_available()


@pytest.mark.parametrize("name", [name for name in HERE if HERE[name]])
def test_a_processor_that_has_more_than_the_machine_is_refused(asked, monkeypatch, name):
    lacking = HERE[name][-1]
    on_a_machine_with(monkeypatch, *HERE[name][:-1])
    asked(name)
    with pytest.raises(ValueError, match=f"{VARIABLE}='{name}' needs {lacking}, which this machine .* lacks"):
        loader.takes(np.zeros(3))


def test_off_is_no_machine_code(asked):
    asked("off")
    assert not loader.is_available()
    assert not loader.takes(np.zeros(3))


def test_keys_know_the_processor(asked):
    keys = set()
    for name in ("native", *(name for name in HERE if set(HERE[name]) <= available())):
        asked(name)
        keys.add(loader._key("block_kernels", "float64"))
        assert loader.is_available()
    assert len(keys) > 1 or not HERE


def available():
    return {name for name, there in binding.get_host_cpu_features().items() if there}
