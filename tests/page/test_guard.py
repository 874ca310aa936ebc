"""Who is answered: this machine, this page, this key."""

import pytest

from roughcontact.page.server.guard import Guard

GUARD = Guard(8765, "key")
HOST, COOKIE = (b"host", b"127.0.0.1:8765"), (b"cookie", b"roughcontact-8765=key")


def status(*headers, method="GET", path="/", query=""):
    refused = GUARD.check(method, path, query, headers)
    return None if refused is None else refused.status


def test_the_key_in_the_address_or_in_the_cookie_is_enough():
    assert status(HOST, query="token=key") is None
    assert status(HOST, COOKIE) is None
    assert status(HOST, COOKIE, (b"origin", b"http://127.0.0.1:8765"), method="POST", path="/request") is None


@pytest.mark.parametrize(
    "host",
    [
        b"evil.example:8765",
        b"127.0.0.1:80",
        b"127.0.0.1",
        b"127.0.0.1.evil.example:8765",
        b"127.0.0.1:8765.evil.example",
        b"[::1]:8765",  # where this server does not listen, and another one may
        b"0.0.0.0:8765",
        b"2130706433:8765",
        b"user@127.0.0.1:8765",
        b"",
    ],
)
def test_another_host_is_refused(host):
    assert status((b"host", host), COOKIE) == 400


def test_two_hosts_and_none_are_refused():
    assert status(HOST, HOST, COOKIE) == status(COOKIE) == 400


@pytest.mark.parametrize(
    "header",
    [
        (b"origin", b"http://evil.example"),
        (b"origin", b"null"),
        (b"origin", b"https://127.0.0.1:8765"),
        (b"origin", b"http://127.0.0.1:8766"),
        (b"sec-fetch-site", b"cross-site"),
        (b"sec-fetch-site", b"same-site"),  # another port of this machine
    ],
)
def test_another_site_is_refused(header):
    assert status(HOST, COOKIE, header, method="POST", path="/request") == 403


def test_without_the_key_there_is_nothing():
    assert status(HOST) == status(HOST, query="token=other") == 403
    assert status(HOST, query="token=key", path="/request", method="POST") == 403
    assert status(HOST, (b"cookie", b"roughcontact-8765=other")) == 403


def test_a_part_of_the_key_two_keys_and_one_in_a_long_address_are_no_key():
    for query in ("token=ke", "token=keyy", "token=", "token=key&token=key", "token=key&x=" + "x" * 1000):
        assert status(HOST, query=query) == 403
    assert status(HOST, query="token=") == status(HOST, query="") == 403
