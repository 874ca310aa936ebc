"""What the application gives to whom: asked as somebody who means harm would ask."""

import asyncio
import re
from importlib import resources
from time import monotonic

import pytest

pytest.importorskip("starlette", reason="the page needs the extra 'page'")

from asgi import answer
from roughcontact.page.jobs.session_cache import UploadedFile
from roughcontact.page.server import uploads
from roughcontact.page.server.guard import HEADERS, Guard
from roughcontact.page.server.page_app import PageServer, application
from roughcontact.page.server.workers import MOST_SESSIONS, Sessions

HOST = ("host", "127.0.0.1:8765")
KNOWN = (HOST, ("cookie", "roughcontact-8765=key"))
STATIC = resources.files("roughcontact.page") / "static"


@pytest.fixture
def server(tmp_path):
    return PageServer(Guard(8765, "key"), Sessions(tmp_path))


def asked(server, *requests):
    """Return the answers to requests that come one after the other."""

    async def all_of_them():
        app = application(server)
        return [await answer(app, *each) for each in requests]

    return asyncio.run(all_of_them())


def post(path, query="", body=()):
    return ("POST", path, query, KNOWN, body)


def begun(server):
    [found] = asked(server, post("/session"))
    return found.json["session"]


def put(session, name="part.npy", headers=(), body=(b"heights",)):
    return ("PUT", "/file", f"session={session}&name={name}", (*KNOWN, *headers), body)


def left_in(folder):
    return [path for path in folder.rglob("*") if path.is_file()]


def test_every_answer_bears_the_headers_of_safety(server):
    requests = [
        ("GET", "/", "token=key", (HOST,)),
        ("GET", "/", "", KNOWN),
        ("GET", "/main.js", "", KNOWN),
        ("GET", "/", "", (("host", "evil.example"),)),
        ("GET", "/", "", (HOST,)),
        ("GET", "/nothing", "", KNOWN),
        ("GET", "/session", "", KNOWN),
        post("/request", "session=none"),
        post("/session"),
    ]
    found = asked(server, *requests)
    assert [each.status for each in found] == [303, 200, 200, 400, 403, 404, 405, 410, 200]
    for each in found:
        assert {name: each[name.lower()] for name in HEADERS} == HEADERS


def test_the_token_leaves_the_address_and_lives_where_no_script_sees_it(server):
    [found] = asked(server, ("GET", "/", "token=key", (HOST,)))
    assert found["location"] == "/"
    words = found["set-cookie"].lower()
    assert "roughcontact-8765=key" in words
    assert "httponly" in words
    assert "samesite=strict" in words
    assert found["referrer-policy"] == "no-referrer"


def test_what_all_users_of_the_machine_can_read_opens_the_page_once(tmp_path):
    server = PageServer(Guard(8765, "key", "once"), Sessions(tmp_path))
    first, second, cookie = asked(
        server,
        ("GET", "/", "token=once", (HOST,)),
        ("GET", "/", "token=once", (HOST,)),
        ("GET", "/", "", (HOST, ("cookie", "roughcontact-8765=once"))),
    )
    assert "roughcontact-8765=key" in first["set-cookie"]
    assert "set-cookie" not in dict(second.headers)
    assert cookie.status == 403
    [again] = asked(server, ("GET", "/", "token=key", (HOST,)))
    assert "set-cookie" in dict(again.headers)


def test_the_policy_allows_no_script_but_its_files_and_the_page_needs_none():
    assert "unsafe" not in HEADERS["Content-Security-Policy"]
    assert "http" not in HEADERS["Content-Security-Policy"]
    words = (STATIC / "index.html").read_text(encoding="utf-8")
    assert re.findall(r"<script(?![^>]*\bsrc=)|<style|\s(?:on\w+|style)=", words) == []
    assert re.findall(r"(?:src|href|action)=\"(?!/|data:,|#)", words) == []


@pytest.mark.parametrize(
    "path",
    [
        "/../page_app.py",
        "/..%2fpage_app.py",
        "/vendor/../../serve.py",
        "/%2e%2e/%2e%2e/validation.py",
        "//etc/passwd",
        "/static/main.js",
        "/vendor",
        "/index.html",
        "/main.js/",
        "/main.js\0",
    ],
)
def test_nothing_but_the_files_of_the_page_can_be_asked_for(server, path):
    """A path with a slash too many is sent to the one without it, which is a file of the page or nothing."""
    [found] = asked(server, ("GET", path, "", KNOWN))
    assert found.status == 404 or (found.status == 307 and found["location"].endswith("/main.js"))


def test_nobody_is_spoken_to_but_by_http(server):
    async def spoken():
        sent = []

        async def send(message):
            sent.append(message)

        async def receive():
            return {"type": "websocket.connect"}

        await application(server)({"type": "websocket", "path": "/", "headers": []}, receive, send)
        return sent

    assert asyncio.run(spoken()) == []


@pytest.mark.parametrize(
    "name",
    [
        "../../x",
        "..\\..\\x",
        "/etc/passwd",
        "..",
        "",
        "%00",
        "%0a",
        "%2e%2e%2f%2e%2e%2fx",
        "~root",
        "a" * 500 + ".npy",
        "表面" * 200 + ".npy",
        "-rf",
    ],
)
def test_a_dropped_file_lies_in_the_folder_of_its_session_whatever_its_name(server, tmp_path, name):
    session = begun(server)
    [found] = asked(server, put(session, name))
    assert found.status == 200
    [file] = left_in(tmp_path)
    assert file.parent.parent == tmp_path / session
    assert file.resolve() == file
    assert file.read_bytes() == b"heights"
    if name.endswith(".npy"):
        assert file.suffix == ".npy"
    shown = found.json["name"]
    assert shown.isprintable()
    assert not shown.startswith("-")


def test_what_says_that_it_is_too_large_is_refused_before_any_of_it_comes(server, tmp_path):
    too_much = [("content-length", str(2**30))]
    session = begun(server)
    [found] = asked(server, put(session, headers=too_much, body=[None]))
    assert found.status == 413
    assert "512 MB" in found.json["message"]
    assert left_in(tmp_path) == []


@pytest.mark.parametrize("length", [[], [("content-length", "10")], [("content-length", "ten")]])
def test_what_grows_too_large_is_refused_and_removed(server, tmp_path, monkeypatch, length):
    monkeypatch.setattr(uploads, "LARGEST", 1000)
    session = begun(server)
    [found] = asked(server, put(session, headers=length, body=[b"x" * 100] * 11 + [None]))
    assert found.status == 413
    assert left_in(tmp_path) == []
    assert list((tmp_path / session).iterdir()) == []


def test_a_tab_drops_so_much_and_no_more(server, tmp_path, monkeypatch):
    monkeypatch.setattr(uploads, "LARGEST", 1000)
    monkeypatch.setattr(uploads, "_TOGETHER", 2000)
    session = begun(server)
    found = asked(server, *(put(session, body=[b"x" * 600]) for _ in range(3)))
    assert [each.status for each in found] == [200, 200, 413]
    assert "reload the page" in found[-1].json["message"]
    assert len(left_in(tmp_path)) == 2


def test_what_no_longer_comes_is_given_up_and_removed(server, tmp_path, monkeypatch):
    monkeypatch.setattr(uploads, "_PATIENCE", 0.01)
    session = begun(server)
    [found] = asked(server, put(session, body=[b"x", None]))
    assert found.status == 408
    assert list((tmp_path / session).iterdir()) == []


def test_a_disk_that_takes_nothing_is_said(server, tmp_path):
    session = begun(server)
    (tmp_path / session).rmdir()
    [found] = asked(server, put(session))
    assert found.status == 507
    assert "cannot store the file" in found.json["message"]


@pytest.mark.parametrize(
    "body", ["", "[]", "{", '{"queue": NaN}', '{"more": []}', "[" * 100_000, '{"load": 1e999}', "9" * 9999]
)
def test_an_order_that_is_none_is_refused(server, body):
    session = begun(server)
    [found] = asked(server, post("/request", f"session={session}", [body.encode()]))
    assert found.status == 400


def test_an_endless_order_is_refused(server):
    session = begun(server)
    [found] = asked(server, post("/request", f"session={session}", [b" " * 2**16] * 17 + [None]))
    assert found.status == 413


@pytest.mark.parametrize("path", ["/request", "/stop", "/alive"])
def test_a_session_answers_to_its_key_alone(server, path):
    session = begun(server)
    for key in ("", "x", session[:-1], session + "0"):
        [found] = asked(server, post(path, f"session={key}", [b"{}"]))
        assert found.status == 410


def test_a_session_holds_its_own_files_and_the_one_of_the_command_line(tmp_path):
    given = UploadedFile(tmp_path / "part.x3p", "part.x3p")
    server = PageServer(Guard(8765, "key"), Sessions(tmp_path, given))
    first, second = begun(server), begun(server)
    [found] = asked(server, put(first))
    known = server.sessions.known
    assert known[first].files.keys() == {"given", found.json["file"]}
    assert known[second].files == {"given": given}


def test_the_files_of_a_session_go_with_it_and_no_others(server, tmp_path):
    server.sessions.grace = 0.0
    first, second = begun(server), begun(server)

    async def left():
        app = application(server)
        for each in (put(first), put(second), post("/end", f"session={first}"), post("/end", "session=x")):
            await answer(app, *each)
        while first in server.sessions.known:
            await asyncio.sleep(0)

    asyncio.run(left())
    [file] = left_in(tmp_path)
    assert file.parent.parent == tmp_path / second
    assert server.sessions.known.keys() == {second}


def test_a_tab_that_is_loaded_again_has_its_session_with_its_files(server):
    """A tab that was copied, and so names a session that another tab still has, gets one of its own."""
    session = begun(server)
    again = post("/session", f"again={session}")
    file, copied, _, back = asked(server, put(session), again, post("/end", f"session={session}"), again)
    assert copied.json["session"] != session
    assert copied.json["files"] == {}
    assert back.json["session"] == session
    assert back.json["files"] == {file.json["file"]: "part.npy"}
    assert server.sessions.known[session].leaving is None


def test_too_many_tabs_are_refused_until_one_has_long_been_silent(server):
    keys = [begun(server) for _ in range(MOST_SESSIONS)]
    [refused] = asked(server, post("/session"))
    assert refused.status == 503
    assert "close one" in refused.json["message"]
    server.sessions.known[keys[3]].heard = monotonic() - server.sessions.room - 1
    [found] = asked(server, post("/session"))
    assert found.status == 200
    assert server.sessions.known.keys() == {*keys[:3], *keys[4:], found.json["session"]}


@pytest.mark.parametrize("comes_back", [True, False])
def test_a_new_tab_waits_until_the_session_of_a_closed_one_ends(server, comes_back):
    """The closed tab may only be loaded again, and then finds its session and its files."""
    sessions, keys = server.sessions, [begun(server) for _ in range(MOST_SESSIONS)]
    sessions.grace = 60.0 if comes_back else 0.0

    async def opened():
        sessions.leave(keys[3])
        new = asyncio.create_task(sessions.begin())
        await asyncio.sleep(0)
        assert keys[3] in sessions.known
        assert not comes_back or sessions.back(keys[3])
        return await new

    new = asyncio.run(opened())
    assert sessions.known.keys() == ({*keys} if comes_back else {*keys, new} - {keys[3]})


def test_a_session_of_which_nothing_is_heard_ends_and_leaves_no_file(server, tmp_path, monkeypatch):
    """The one that speaks, and the one for which something is computed, stay."""
    silent, spoken, busy = (begun(server) for _ in range(3))
    asked(server, put(silent))
    server.sessions.silent = 10.0
    monkeypatch.setattr(Sessions, "_start", lambda _: asyncio.Event().wait())

    async def watched():
        await server.sessions.known[busy].back.turn.acquire()
        for each in server.sessions.known.values():
            each.heard = monotonic() - 11
        assert (await answer(application(server), *post("/alive", f"session={spoken}"))).status == 200
        async with server.sessions.running():
            while silent in server.sessions.known or left_in(tmp_path):
                await asyncio.sleep(0.01)

    asyncio.run(watched())
    assert server.sessions.known.keys() == {spoken, busy}
    assert left_in(tmp_path) == []
