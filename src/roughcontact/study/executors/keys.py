"""Keys of one run, by which a scheduler and its workers know each other: nobody else can give them work."""

from __future__ import annotations

import os
import shlex
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from roughcontact.study.executors.worker import WorkersError, require_cluster

if TYPE_CHECKING:
    from distributed import Security

__all__ = ["NO_PAGES", "as_folder", "keys_in", "require_keys", "write_keys"]

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


def as_folder(name: str) -> str:
    """Return a folder for keys, as a command of a job can name it.

    Raises
    ------
    WorkersError
        If a shell would read the name as something else.
    """
    folder = os.path.abspath(os.path.expanduser(os.path.expandvars(name)))
    if shlex.quote(folder) != folder:
        raise WorkersError(
            f"jobs cannot find keys in the folder {folder!r}: give shared_temp_directory=, or shared-temp-directory in "
            "~/.config/dask/jobqueue.yaml, a folder that all nodes see, with neither spaces nor quotes in its name"
        )
    return folder


@contextmanager
def keys_in(folder: str) -> Iterator[Security]:
    """Keep new keys in a folder, where only this user can read them, for as long as the block runs."""
    from distributed import Security

    with tempfile.TemporaryDirectory(prefix=".roughcontact-keys-", dir=folder) as place:
        certificate, key = write_keys(place)
        roles = ("client", "scheduler", "worker")
        yield Security(
            require_encryption=True,
            tls_ca_file=certificate,
            **{f"tls_{role}_cert": certificate for role in roles},
            **{f"tls_{role}_key": key for role in roles},
        )


def write_keys(folder: str) -> tuple[str, str]:
    """Write new keys to ``cert.pem`` and ``key.pem`` of a folder, for this user alone; return the two paths."""
    from distributed import Security

    made = Security.temporary()
    written = []
    for name, text in ("cert.pem", made.tls_worker_cert), ("key.pem", made.tls_worker_key):
        path = Path(folder, name)
        path.touch(mode=0o600, exist_ok=False)
        path.write_text(text, encoding="ascii")
        written.append(str(path))
    return written[0], written[1]
