"""Keys of one run, with which a scheduler and its workers identify each other: no other user can send them tasks."""

from __future__ import annotations

from pathlib import Path

from roughcontact.study.executors.worker import require_cluster

__all__ = ["NO_PAGES", "require_keys", "write_keys"]

# Configuration of Dask: without these routes the unprotected servers for status pages show nothing.
NO_PAGES: dict[str, object] = {
    "distributed.scheduler.http.routes": [],
    "distributed.worker.http.routes": [],
}


def require_keys() -> None:
    """Raise an error if a scheduler could not be protected against other users.

    Raises
    ------
    WorkersError
        If cryptography is not installed.
    """
    require_cluster("cryptography.x509", "cryptography, which makes the keys of the workers,")


def write_keys(folder: str) -> None:
    """Write new keys to ``cert.pem`` and ``key.pem`` of a folder, readable only by this user."""
    from distributed import Security

    made = Security.temporary()
    for name, text in ("cert.pem", made.tls_worker_cert), ("key.pem", made.tls_worker_key):
        path = Path(folder, name)
        path.touch(mode=0o600, exist_ok=False)
        path.write_text(text, encoding="ascii")
