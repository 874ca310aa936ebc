"""Requests to an application as its server makes them: no client in between that mends what is asked."""

import asyncio
import json
from dataclasses import dataclass


@dataclass(frozen=True)
class Answer:
    status: int
    headers: tuple
    body: bytes

    def __getitem__(self, name):
        """Return the header of that name, which there is once."""
        [value] = [value for key, value in self.headers if key == name]
        return value

    @property
    def json(self):
        return json.loads(self.body)


async def answer(app, method, path, query="", headers=(), body=()):
    """Return the answer to a request whose body comes in parts; a part that is None never comes."""
    parts, sent = iter([*body, b""]), []

    async def receive():
        part = next(parts, None)
        if part is None:
            await asyncio.Event().wait()
        return {"type": "http.request", "body": part, "more_body": part != b""}

    async def send(message):
        sent.append(message)

    scope = {
        "type": "http",
        "asgi": {"version": "3.0"},
        "http_version": "1.1",
        "method": method,
        "scheme": "http",
        "path": path,
        "raw_path": path.encode(),
        "query_string": query.encode(),
        "root_path": "",
        "headers": [(name.encode(), value.encode()) for name, value in headers],
        "client": ("127.0.0.1", 40000),
        "server": ("127.0.0.1", 8765),
    }
    await app(scope, receive, send)
    found = tuple((name.decode(), value.decode()) for name, value in sent[0]["headers"])
    return Answer(sent[0]["status"], found, b"".join(each.get("body", b"") for each in sent[1:]))
