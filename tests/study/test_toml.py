import math
import tomllib

import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from roughcontact.study.toml import toml_of

TEXT = st.text(st.characters(codec="utf-8"), max_size=8)
SINGLE = st.booleans() | st.integers() | st.floats(allow_nan=False) | TEXT
VALUE = st.recursive(
    SINGLE, lambda v: st.lists(v, max_size=3) | st.dictionaries(TEXT, v, max_size=3), max_leaves=6
)
TABLE = st.dictionaries(TEXT, VALUE, min_size=1, max_size=3)


# On a busy machine making such tables takes its time.
@settings(deadline=None, max_examples=50, suppress_health_check=[HealthCheck.too_slow])
@given(TABLE, TABLE, st.lists(TABLE, min_size=1, max_size=2))
def test_what_is_written_is_read_back(head, table, rows):
    head = {f"h{name}": value for name, value in head.items()}
    back = tomllib.loads(toml_of(head, {"table": table}, {"rows": rows}))
    assert back == head | {"table": table, "rows": rows}


def test_numbers_keep_every_bit():
    back = tomllib.loads(toml_of({"a": 1e-07, "b": -0.0, "c": math.inf, "d": 10**30}, {}, {}))
    assert (back["a"], math.copysign(1, back["b"]), back["c"], back["d"]) == (1e-7, -1, math.inf, 10**30)


def test_what_has_no_place_is_refused():
    with pytest.raises(ValueError, match="None has no place in a study file: give numbers"):
        toml_of({"a": [None]}, {}, {})
