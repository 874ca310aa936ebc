"""Access to the page: only for a browser on this machine that has the token."""

from __future__ import annotations

import hmac
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from http.cookies import CookieError, SimpleCookie
from types import MappingProxyType
from urllib.parse import parse_qs

__all__ = ["HEADERS", "Guard", "Refused"]

HEADERS: Mapping[str, str] = MappingProxyType(
    {
        "Content-Security-Policy": "default-src 'self'; img-src 'self' data: blob:; object-src 'none'; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
        "X-Content-Type-Options": "nosniff",
        "X-Frame-Options": "DENY",
        "Referrer-Policy": "no-referrer",
        "Cross-Origin-Opener-Policy": "same-origin",
        "Cross-Origin-Resource-Policy": "same-origin",
        "Permissions-Policy": "camera=(), geolocation=(), microphone=(), payment=(), usb=()",
        "Cache-Control": "no-store",
    }
)


@dataclass(frozen=True, slots=True)
class Refused:
    """A request that is refused: status and reason."""

    status: int
    reason: str


@dataclass(frozen=True, slots=True)
class Guard:
    """The conditions that a request must meet.

    Parameters
    ----------
    port : int
        The port of this server.
    token : str
        The token for the user.
    once : str
        A second token, for the command that opens the browser: all users of the machine can read the words of that
        command. It opens the page only once. Empty if there is no such command.
    """

    port: int
    token: str
    once: str = ""

    @property
    def cookie(self) -> str:
        """Name of the cookie that holds the token; browsers keep those of all ports of a host together."""
        return f"roughcontact-{self.port}"

    @property
    def hosts(self) -> tuple[str, ...]:
        """The allowed names of the server: another name points to it from elsewhere."""
        return (f"127.0.0.1:{self.port}", f"localhost:{self.port}")

    def check(
        self, method: str, path: str, query: str, headers: Iterable[tuple[bytes, bytes]]
    ) -> Refused | None:
        """Return why a request is refused; None if it is allowed."""
        given: dict[str, list[str]] = {}
        for name, value in headers:
            given.setdefault(name.decode("latin-1").lower(), []).append(value.decode("latin-1"))
        hosts = given.get("host", [])
        if len(hosts) != 1 or hosts[0].lower() not in self.hosts:
            return Refused(400, "This server answers to 127.0.0.1 and localhost only.")
        origins = given.get("origin", [])
        if any(origin.lower() not in {f"http://{host}" for host in self.hosts} for origin in origins):
            return Refused(403, "Another site asked for this.")
        entered = method == "GET" and path == "/"
        site = given.get("sec-fetch-site", ["none"])
        if not entered and any(each not in ("same-origin", "none") for each in site):
            return Refused(403, "Another site asked for this.")
        if (entered and self.entered(query)) or self._has_cookie(given.get("cookie", [])):
            return None
        return Refused(
            403, "Open the address that roughcontact serve printed: it contains the key of this page."
        )

    def entered(self, query: str) -> bool:
        """Return whether the address contains the token for the user or the one for the browser."""
        return self._holds(query, self.token) or self.entered_once(query)

    def entered_once(self, query: str) -> bool:
        """Return whether the address contains the token that opens the page once."""
        return self.once != "" and self._holds(query, self.once)

    def _has_cookie(self, lines: list[str]) -> bool:
        for line in lines:
            try:
                found = SimpleCookie(line).get(self.cookie)
            except CookieError:
                continue
            if found is not None and _same(found.value, self.token):
                return True
        return False

    @staticmethod
    def _holds(query: str, token: str) -> bool:
        tokens = parse_qs(query, max_num_fields=10).get("token", []) if len(query) < 1000 else []
        return len(tokens) == 1 and _same(tokens[0], token)


def _same(given: str, token: str) -> bool:
    """Return whether two tokens are the same, in a time that does not depend on the first difference."""
    return hmac.compare_digest(given.encode(), token.encode())
