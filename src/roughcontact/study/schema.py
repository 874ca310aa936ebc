"""The database of a store: its table, its creation and opening, and its errors with remedies."""

from __future__ import annotations

import os
import sqlite3
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from roughcontact.files.aside import written_aside
from roughcontact.study.study_errors import SAFE, StoreError, on_disk

__all__ = ["DATABASE", "connected", "guarded", "made", "patiently"]

DATABASE = "cases.sqlite"
_VERSION = 1
_OURS = 0x72634373  # "rcCs": whose database a file of SQLite is
_TABLE = """
CREATE TABLE cases (
    key TEXT PRIMARY KEY NOT NULL, -- SHA-256 of case, version, parameters, seed and sample
    sample INTEGER NOT NULL,
    parameters TEXT NOT NULL,      -- JSON, in SI
    status TEXT NOT NULL CHECK (status IN ('done', 'failed')),
    message TEXT NOT NULL,         -- why it failed
    seconds REAL NOT NULL,         -- wall time
    version TEXT NOT NULL,         -- of roughcontact
    residual REAL,                 -- certificate
    record TEXT,                   -- JSON
    checksum TEXT NOT NULL         -- of all these
)
"""
_PATIENCE = 600.0  # seconds that the writer waits for readers: on a slow disk, reading all rows takes minutes
_BREATH = 5.0  # seconds at a time, in which Ctrl-C has no effect
_BACKUP = (
    "put a backup in its place, or save the readable part with the command .recover of sqlite3; "
    "if you move it away, its cases are computed again"
)
# Problem and remedy, by the beginning of SQLite's name of an error.
_TROUBLE = {
    "SQLITE_FULL": ("the disk is full", f"make room and run again; {SAFE}"),
    "SQLITE_IOERR": (
        "the disk cannot be written or read ({})",
        f"check whether it is full or disconnected, and run again; {SAFE}",
    ),
    "SQLITE_CORRUPT": (f"{DATABASE} is damaged ({{}})", _BACKUP),
    "SQLITE_NOTADB": (f"{DATABASE} is damaged, or is not a database ({{}})", _BACKUP),
    "SQLITE_BUSY": (
        f"another program has locked {DATABASE} for minutes",
        f"end it (an open sqlite3 shell?) and run again; {SAFE}",
    ),
    "SQLITE_READONLY": (
        f"{DATABASE} cannot be written ({{}})",
        f"change its permissions, or copy the folder elsewhere and resume there; {SAFE}",
    ),
    "SQLITE_CANTOPEN": (
        f"{DATABASE} cannot be opened, or its folder cannot be written ({{}})",
        f"change the permissions of the folder, or copy it elsewhere and resume there; {SAFE}",
    ),
}


def made(folder: Path) -> None:
    """Make the database of a folder unless it exists.

    Raises
    ------
    StoreError
        If it cannot be written.
    """
    path = folder / DATABASE
    if path.exists():
        return
    # In a temporary file, so that a database without its table never exists.
    with (
        on_disk(folder, f"{DATABASE} cannot be made"),
        written_aside(path) as aside,
        guarded(folder),
        closing(sqlite3.connect(aside)) as connection,
    ):
        connection.execute(f"PRAGMA application_id = {_OURS}")
        connection.execute(f"PRAGMA user_version = {_VERSION}")
        connection.execute(_TABLE)
        connection.commit()


def connected(folder: Path, *, write: bool) -> sqlite3.Connection:
    """Return a connection to the database of a folder, after an integrity check.

    Raises
    ------
    StoreError
        If it is missing, of another program, of a newer version, damaged, or cannot be written.
    """
    path = folder / DATABASE
    if not path.is_file():
        raise StoreError(
            folder, f"there is no {DATABASE} in it", "run the study, or name the folder of its results"
        )
    with guarded(folder):
        if path.stat().st_size == 0:
            raise StoreError(folder, f"{DATABASE} is empty", _BACKUP)
        # A reader also opens it for writing, because the next connection must undo an unfinished transaction of a
        # killed writer.
        connection = sqlite3.connect(
            f"{path.absolute().as_uri()}?mode=rw", uri=True, timeout=_BREATH, isolation_level=None
        )
    try:
        with guarded(folder):
            _check(connection, folder)
            connection.execute("PRAGMA synchronous = FULL")
            if write:
                patiently(connection, "BEGIN IMMEDIATE")
                connection.execute("ROLLBACK")
            else:
                connection.execute("PRAGMA query_only = ON")
    except BaseException:
        connection.close()
        raise
    return connection


def patiently(connection: sqlite3.Connection, statement: str) -> None:
    """Execute a statement that may have to wait for reading programs."""
    end = time.monotonic() + _PATIENCE
    while True:
        try:
            connection.execute(statement)
            return
        except sqlite3.OperationalError as error:
            if not error.sqlite_errorname.startswith("SQLITE_BUSY") or time.monotonic() > end:
                raise


def _check(connection: sqlite3.Connection, folder: Path) -> None:
    (ours,) = connection.execute("PRAGMA application_id").fetchone()
    (version,) = connection.execute("PRAGMA user_version").fetchone()
    if ours != _OURS:
        raise StoreError(
            folder,
            f"{DATABASE} is not a database of cases, or its beginning is damaged",
            f"choose another folder, or {_BACKUP}",
        )
    if version != _VERSION:
        raise StoreError(
            folder,
            f"{DATABASE} has version {version}, but this roughcontact reads version {_VERSION}",
            "use the newer roughcontact that made it",
        )
    problems = [line for (line,) in connection.execute("PRAGMA integrity_check(1)")]
    if problems != ["ok"]:
        raise StoreError(folder, f"{DATABASE} is damaged ({' '.join(problems[0].split())})", _BACKUP)
    connection.execute("SELECT * FROM cases LIMIT 1").fetchone()


@contextmanager
def guarded(folder: str | os.PathLike[str]) -> Iterator[None]:
    """Turn errors of the database into a StoreError with a remedy."""
    try:
        yield
    except sqlite3.Error as error:
        name = getattr(error, "sqlite_errorname", "")
        for beginning, (problem, remedy) in _TROUBLE.items():
            if name.startswith(beginning):
                raise StoreError(folder, problem.format(error), remedy) from error
        raise StoreError(folder, f"{DATABASE} cannot be used ({error})", _BACKUP) from error
    except UnicodeDecodeError as error:  # of text in the database
        raise StoreError(folder, f"{DATABASE} is damaged ({error})", _BACKUP) from error
