"""The page as a web application: a few routes behind a guard."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections.abc import AsyncGenerator, Awaitable, Callable
from dataclasses import dataclass, field
from importlib import resources
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse, PlainTextResponse, RedirectResponse, Response
from starlette.routing import Route
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from roughcontact.page.server.guard import HEADERS, Guard, Refused
from roughcontact.page.server.uploads import LARGEST, TooLargeError, TooSlowError, store
from roughcontact.page.server.workers import GIVEN, MOST_SESSIONS, Session, Sessions

__all__ = ["PageServer", "application"]

_LONGEST_REQUEST = 2**20  # bytes of JSON
_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
}


@dataclass(slots=True, eq=False)
class PageServer:
    """The common state of the routes.

    Parameters
    ----------
    guard : Guard
    sessions : Sessions
    closing : asyncio.Event
        Set when the server is about to end: unfinished answers are broken off.
    opened : bool
        Whether the token that opens the page once has been used.
    """

    guard: Guard
    sessions: Sessions
    closing: asyncio.Event = field(default_factory=asyncio.Event)
    opened: bool = False

    async def begin(self, request: Request) -> Response:
        """Open a session for a tab, or return the earlier session of a reloaded tab."""
        before = request.query_params.get("again", "")
        key = before if self.sessions.back(before) else await self.sessions.begin()
        if key is None:
            words = f"{MOST_SESSIONS} tabs are open, the maximum number: close one."
            return _refusal(503, words)
        file = self.sessions.given
        given = None if file is None else {"file": GIVEN, "name": file.name}
        files = {name: each.name for name, each in self.sessions.known[key].files.items()}
        about = {"session": key, "files": files, "given": given, "largest": LARGEST}
        return JSONResponse(about | _choices())

    def in_session(self, answer: Callable[[Session, Request], Awaitable[ASGIApp]]) -> Callable[..., Any]:
        """Return an endpoint that refuses requests without an open session."""

        async def endpoint(request: Request) -> ASGIApp:
            session = self.sessions.find(request.query_params.get("session", ""))
            if session is None:
                return _refusal(410, "The session of this tab has ended: reload the page.")
            return await answer(session, request)

        return endpoint

    async def upload(self, session: Session, request: Request) -> Response:
        """Store a file."""
        stated = request.headers.get("content-length", "")
        name = request.query_params.get("name", "file")
        try:
            size = int(stated) if stated.isascii() and stated.isdigit() else None
            key, file = await store(session.folder, name, size, request.stream())
        except TooLargeError as error:
            return _refusal(413, str(error))
        except TooSlowError as error:
            return _refusal(408, str(error))
        except ClientDisconnect:
            return Response(status_code=400)
        except OSError as error:
            return _refusal(507, f"The server cannot store the file: {error.strerror or error}.")
        session.files[key] = file
        return JSONResponse({"file": key, "name": file.name})

    async def perform(self, session: Session, request: Request) -> ASGIApp:
        """Answer a request, message by message."""
        body = b""
        async for part in request.stream():
            body += part
            if len(body) > _LONGEST_REQUEST:
                return _refusal(413, "The request is longer than 1 MB.")
        asked = _asked(body)
        if asked is None:
            return _refusal(400, "A request must be an object of JSON.")
        return _Streamed(session.perform(asked), self.closing)

    async def stop(self, session: Session, request: Request) -> Response:
        """Stop a request."""
        await session.queue(request.query_params.get("queue")).stop(request.query_params.get("key", ""))
        return JSONResponse({})

    async def leave(self, request: Request) -> Response:
        """End a session whose tab is closed, unless it is only loaded again."""
        self.sessions.leave(request.query_params.get("session", ""))
        return JSONResponse({})

    async def alive(self, session: Session, request: Request) -> Response:
        """Answer a sign of life from a tab; the session of a silent tab is ended."""
        return JSONResponse({})


def application(server: PageServer) -> ASGIApp:
    """Return the application of a server, behind its guard."""
    files = dict(_files())
    entry = files.pop("/index.html")

    async def page(request: Request) -> Response:
        guard, query = server.guard, request.url.query
        if guard.entered(query):
            # The token is removed from the address line, where others could read it.
            response: Response = RedirectResponse("/", 303)
            if not (guard.entered_once(query) and server.opened):
                server.opened = server.opened or guard.entered_once(query)
                response.set_cookie(guard.cookie, guard.token, httponly=True, samesite="strict", path="/")
            return response
        return Response(entry, media_type=_TYPES[".html"])

    async def file(request: Request) -> Response:
        path = request.url.path
        return Response(files[path], media_type=_TYPES[Path(path).suffix])

    routes = [
        Route("/", page),
        *(Route(path, file) for path in files),
        Route("/session", server.begin, methods=["POST"]),
        Route("/file", server.in_session(server.upload), methods=["PUT"]),
        Route("/request", server.in_session(server.perform), methods=["POST"]),
        Route("/stop", server.in_session(server.stop), methods=["POST"]),
        Route("/alive", server.in_session(server.alive), methods=["POST"]),
        Route("/end", server.leave, methods=["POST"]),
    ]
    return _Guarded(Starlette(routes=routes, lifespan=lambda _: server.sessions.running()), server.guard)


@dataclass(frozen=True, slots=True)
class _Guarded:
    """An application behind a guard; every answer has the security headers."""

    app: ASGIApp
    guard: Guard

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
        if scope["type"] != "http":
            return

        async def send_safely(message: Message) -> None:
            if message["type"] == "http.response.start":
                safe = [(name.lower().encode(), value.encode()) for name, value in HEADERS.items()]
                message = {**message, "headers": [*message.get("headers", []), *safe]}
            await send(message)

        query = scope["query_string"].decode("latin-1")
        refused = self.guard.check(scope["method"], scope["path"], query, scope["headers"])
        app = self.app if refused is None else _hung_up(refused)
        await app(scope, receive, send_safely)


def _hung_up(refused: Refused) -> Response:
    """Return an answer after which the connection is closed: a client without the key is not read further."""
    return PlainTextResponse(refused.reason + "\n", refused.status, {"Connection": "close"})


@dataclass(frozen=True, slots=True)
class _Streamed:
    """Messages as they come, until the browser disconnects or the server is about to end."""

    messages: AsyncGenerator[bytes]
    closing: asyncio.Event

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        headers = [(b"content-type", b"application/octet-stream")]
        await send({"type": "http.response.start", "status": 200, "headers": headers})
        sending = asyncio.create_task(self._send(send))
        others = [asyncio.create_task(_left(receive)), asyncio.create_task(self.closing.wait())]
        try:
            await asyncio.wait({sending, *others}, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for each in (sending, *others):
                each.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await sending
        await send({"type": "http.response.body", "body": b"", "more_body": False})

    async def _send(self, send: Send) -> None:
        async with contextlib.aclosing(self.messages) as messages:
            async for message in messages:
                await send({"type": "http.response.body", "body": message, "more_body": True})


async def _left(receive: Receive) -> None:
    while (await receive())["type"] != "http.disconnect":
        pass


def _asked(body: bytes) -> dict[str, Any] | None:
    """Return the object in a body; None for other values, or numbers that are not valid JSON."""
    try:
        asked = json.loads(body)
        json.dumps(asked, allow_nan=False)
    except (ValueError, RecursionError):
        return None
    plain = isinstance(asked, dict) and isinstance(asked.get("more"), dict | None)
    return asked if plain else None


def _refusal(status: int, words: str) -> Response:
    """Return a refusal; the connection is closed, because the rest of a body may be on its way."""
    return JSONResponse({"message": words}, status, {"Connection": "close"})


def _choices() -> dict[str, Any]:
    """Return the values that can be chosen by name."""
    from roughcontact.page.forms import forms
    from roughcontact.theory.laws import LAWS

    given = {"hardness", "radius"}  # numbers that a surface does not determine
    laws = {name: law.about for name, law in LAWS.items() if not given & {*law.needs} - {"hardness"}}
    return {"forms": forms(), "theories": laws}


def _files() -> list[tuple[str, bytes]]:
    """Return the files of the page by their paths; no other file of the disk is served."""
    found: list[tuple[str, bytes]] = []
    folders = [("", resources.files("roughcontact.page") / "static")]
    while folders:
        path, folder = folders.pop()
        for each in folder.iterdir():
            if each.is_dir():
                folders.append((f"{path}/{each.name}", each))
            elif Path(each.name).suffix in _TYPES:
                found.append((f"{path}/{each.name}", each.read_bytes()))
    return found
