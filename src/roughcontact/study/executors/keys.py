"""Keys of one run, by which a scheduler and its workers know each other: nobody else can give them work."""

from __future__ import annotations

from pathlib import Path

from roughcontact.study.executors.worker import require_cluster

__all__ = ["NO_PAGES", "require_keys", "write_keys"]

# Of Dask's configuration: without these the servers for status pages, which ask for no keys, show nothing.
NO_PAGES: dict[str, object] = {
    "distributed.scheduler.http.routes": [],
    "distributed.worker.http.routes": [],
}


def require_keys() -> None:
    """Refuse to start a scheduler that cannot tell its user from others.

    Raises
    ------
    WorkersError
        If cryptography is not installed.
    """
    require_cluster("cryptography.x509", "cryptography, which makes the keys of the workers,")


def write_keys(folder: str) -> None:
    """Write new keys to ``cert.pem`` and ``key.pem`` of a folder, for this user alone."""
    from distributed import Security

    made = Security.temporary()
    for name, text in ("cert.pem", made.tls_worker_cert), ("key.pem", made.tls_worker_key):
        path = Path(folder, name)
        path.touch(mode=0o600, exist_ok=False)
        path.write_text(text, encoding="ascii")
