"""What the record of every case must be."""

from roughcontact.study.record import decode, encode, require_record


def pure_record(run):
    """Return the record of seed 3: the same each time, another of another seed, and the same after it was stored."""
    one = run(seed=3)
    require_record(one)
    assert one.identical(run(seed=3))
    assert not one.equals(run(seed=4))
    assert decode(encode(one)).identical(one)
    return one
