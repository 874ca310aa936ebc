"""The store of a study: one folder with one database, written by one process."""

from __future__ import annotations

import json
import os
import sqlite3
from collections.abc import Iterator
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from filelock import FileLock, Timeout

from roughcontact.study.cases import find_case
from roughcontact.study.field_files import cleaned, read_fields, split, write_fields
from roughcontact.study.record import COLUMNS, Row, checksum, encode, residual_of
from roughcontact.study.schema import DATABASE, connected, guarded, made, patiently
from roughcontact.study.study import Study
from roughcontact.study.study_errors import StoreError, StudyError, computed_again, disk_trouble, on_disk
from roughcontact.study.task import Summary, canonical
from roughcontact.version import __version__

if TYPE_CHECKING:
    import xarray

    from roughcontact.study.task import Result, Task

__all__ = ["STUDY", "Store"]

STUDY = "study.toml"
_ELSEWHERE = "choose another folder for this one"
_INSERT = f"""
INSERT INTO cases ({", ".join(COLUMNS)}) VALUES ({", ".join("?" * len(COLUMNS))})
ON CONFLICT (key) DO UPDATE SET {", ".join(f"{name} = excluded.{name}" for name in COLUMNS)}
WHERE status = 'failed'
"""
_AT_ONCE = 200  # rows per query, so that a slow reader never delays the writer


class Store:
    """The stored cases of a study. Open it by `Store.open`, in a ``with`` statement.

    Parameters
    ----------
    folder : Path
        The folder of the cases.
    study : Study
        The study that the cases belong to.
    connection : sqlite3.Connection
        Connection to the database of the folder.
    held : ExitStack
        Resources that are released when the store is closed.

    Examples
    --------
    >>> import roughcontact as rc
    >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "hurst": 0.8, "loads": 3}
    >>> study = rc.study.Study(name="few", case="curve", samples=2, parameters=fixed)
    >>> task = next(study.tasks())
    >>> with rc.study.Store.open("few", study) as store:
    ...     store.add(task, rc.study.run_task(task))
    ...     print(store.summary().left, store.outdated(), task.key in store.done_keys(), len(store.failed_keys()))
    ...     print([row.status for row in store.rows()], store.failed())
    1 0 True 0
    ['done'] ()
    """

    __slots__ = ("_connection", "_held", "folder", "study")

    def __init__(self, folder: Path, study: Study, connection: sqlite3.Connection, held: ExitStack) -> None:
        self.folder = folder
        self.study = study
        self._connection = connection
        self._held = held

    @classmethod
    def open(cls, folder: str | os.PathLike[str], study: Study | None = None) -> Store:
        """Open the store in a folder: to read it, or with a `study` to add cases of it.

        Only one process at a time can add cases; any number can read at the same time.

        Parameters
        ----------
        folder : str or path
            With a `study`, it is created if it does not exist.
        study : Study, optional
            The study of a new folder; for an existing one, the same study, possibly with more samples and combinations.

        Returns
        -------
        Store
            Close it after use, as a ``with`` statement does.

        Raises
        ------
        StoreError
            If the folder holds no store, or that of another study; if another process adds cases to it; if it cannot
            be written; if its database is damaged or of a newer version. Its contents stay unchanged.
        """
        place = Path(folder)
        with ExitStack() as held:
            if study is None:
                found = _kept(place)
                connection = connected(place, write=False)
                held.callback(connection.close)
                return cls(place, found, connection, held.pop_all())
            with on_disk(place, "the folder does not exist and cannot be created"):
                place.mkdir(parents=True, exist_ok=True)
            held.callback(_locked(place).release)
            study = study.pinned()
            before = _kept(place) if (place / STUDY).exists() else None
            if before is not None:
                _require_growth(place, before, study)
            made(place)
            connection = connected(place, write=True)
            held.callback(connection.close)
            cleaned(place)
            if before != study:
                with on_disk(place, f"{STUDY} cannot be written"):
                    study.write(place / STUDY)
            return cls(place, study, connection, held.pop_all())

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the store, and release the folder.

        Examples
        --------
        >>> import roughcontact as rc
        >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "hurst": 0.8, "loads": 3}
        >>> store = rc.study.Store.open("few", rc.study.Study(name="few", case="curve", parameters=fixed))
        >>> store.summary().left
        1
        >>> store.close()  # as the end of a with statement does
        """
        self._held.close()

    def add(self, task: Task, result: Result) -> None:
        """Store the result of a task, in one transaction.

        A failed case is replaced; a case that is done stays unchanged.

        Parameters
        ----------
        task : Task
            A task of the study.
        result : Result
            Its result.

        Raises
        ------
        StoreError
            If it cannot be written; stored cases stay.
        """
        record, residual = result.record, None
        if record is not None:
            residual = residual_of(record)
            if task.case.fields:
                record, fields = split(record, task.case.fields)
                # Fields first, so that no row exists without them.
                write_fields(self.folder, task.key, fields)
        values = (
            task.key,
            task.sample,
            json.dumps(task.parameters.model_dump(mode="json")),
            "failed" if record is None else "done",
            result.message.encode("utf-8", "replace").decode("utf-8"),  # invalid characters become ?
            float(result.seconds),
            __version__,
            residual,
            None if record is None else encode(record),
        )
        with guarded(self.folder):
            self._commit((*values, checksum(values)))

    def done_keys(self) -> frozenset[str]:
        """Return the keys of all cases that are done, including those of earlier versions of the case.

        Returns
        -------
        frozenset of str
            Keys as ``Task.key``.
        """
        return self._keys("done")

    def failed_keys(self) -> frozenset[str]:
        """Return the keys of all cases that failed.

        Returns
        -------
        frozenset of str
            Keys as ``Task.key``.
        """
        return self._keys("failed")

    def rows(self) -> Iterator[Row]:
        """Yield the cases of the study that are done or failed, in the order of its tasks.

        Yields
        ------
        Row
            One for each case.

        Raises
        ------
        StoreError
            If one is damaged.
        """
        return self._rows([task.key for task in self.study.tasks()])

    def failed(self) -> tuple[Row, ...]:
        """Return the cases of the study that failed, in the order of its tasks.

        Returns
        -------
        tuple of Row
            One for each case.

        Raises
        ------
        StoreError
            If one is damaged.
        """
        failed = self.failed_keys()
        return tuple(self._rows([task.key for task in self.study.tasks() if task.key in failed]))

    def fields(self, key: str) -> xarray.Dataset:
        """Return the fields of a case.

        Parameters
        ----------
        key : str
            Key of a case.

        Returns
        -------
        xarray.Dataset
            Its fields.

        Raises
        ------
        StoreError
            If the case has no fields.

        Examples
        --------
        >>> import roughcontact as rc
        >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "hurst": 0.8, "loads": 3}
        >>> with rc.study.Store.open("few", rc.study.Study(name="few", case="curve", parameters=fixed)) as store:
        ...     try:
        ...         store.fields("a key")  # this case stores none
        ...     except rc.study.StoreError as error:
        ...         print(error.problem.partition(",")[0])
        there are no fields of the case a key
        """
        return read_fields(self.folder, key)

    def summary(self) -> Summary:
        """Return the progress of the study.

        Returns
        -------
        Summary
            Numbers of cases that are done, failed and left.
        """
        keys = {task.key for task in self.study.tasks()}
        done, failed = len(keys & self.done_keys()), len(keys & self.failed_keys())
        return Summary(done, failed, len(keys) - done - failed)

    def outdated(self) -> int:
        """Return the number of stored cases of earlier versions of the case.

        Returns
        -------
        int
            These cases stay stored, but are not part of the study.
        """
        keys = {task.key for task in self.study.tasks()}
        return len((self.done_keys() | self.failed_keys()) - keys)

    def _keys(self, status: str) -> frozenset[str]:
        with guarded(self.folder):
            found = self._connection.execute("SELECT key FROM cases WHERE status = ?", (status,)).fetchall()
        return frozenset(key for (key,) in found)

    def _rows(self, keys: list[str]) -> Iterator[Row]:
        for start in range(0, len(keys), _AT_ONCE):
            chosen = keys[start : start + _AT_ONCE]
            query = f"SELECT {', '.join(COLUMNS)} FROM cases WHERE key IN ({', '.join('?' * len(chosen))})"
            with guarded(self.folder):
                found = {values[0]: values for values in self._connection.execute(query, chosen).fetchall()}
            for key in chosen:
                if key in found:
                    yield self._row(found[key])

    def _row(self, values: tuple[Any, ...]) -> Row:
        row = Row.of(values)
        if row is None:
            raise StoreError(
                self.folder,
                f"the case {values[0]} in {DATABASE} is damaged",
                f"put a backup in its place; {computed_again(values[0])}",
            )
        return row

    def _commit(self, values: tuple[Any, ...]) -> None:
        connection = self._connection
        patiently(connection, "BEGIN IMMEDIATE")
        try:
            connection.execute(_INSERT, values)
            patiently(connection, "COMMIT")
        except BaseException:
            with suppress(sqlite3.Error):  # some errors already end the transaction
                connection.execute("ROLLBACK")
            raise


def _kept(folder: Path) -> Study:
    """Return the study of a folder."""
    if not (folder / STUDY).is_file():
        remedy = "name the folder of the results of a study; if 'study run' has just started, wait"
        raise StoreError(folder, f"there is no {STUDY} in it", remedy)
    try:
        return Study.read(folder / STUDY)
    except StudyError as error:
        raise StoreError(
            folder,
            f"its {STUDY} cannot be used ({error})",
            "if it is damaged, remove it and run the original file of the study: the cases stay",
        ) from error


def _locked(folder: Path) -> FileLock:
    """Acquire the lock of a store, and return it.

    Raises
    ------
    StoreError
        If another process holds it, or the folder cannot be written.
    """
    lock = FileLock(folder / "lock")
    try:
        lock.acquire(timeout=0)
    except Timeout:
        raise StoreError(
            folder,
            "another process is running a study in this folder",
            "wait until it ends, or stop it with Ctrl-C; 'roughcontact study status' works meanwhile",
        ) from None
    except (OSError, NotImplementedError) as error:  # the latter for file systems without locks
        raise disk_trouble(folder, "the folder cannot be locked for writing", error) from error
    return lock


def _require_growth(folder: Path, before: Study, now: Study) -> None:
    """Raise an error for a study that differs from `before`, or that is smaller.

    Raises
    ------
    StoreError
        If name, case or seed differ, or if samples or combinations are missing.
    """
    for what, one, other in (
        ("name", before.name, now.name),
        ("case", find_case(before.case).name, find_case(now.case).name),
        ("seed", before.seed, now.seed),
    ):
        if one != other:
            raise StoreError(
                folder, f"it holds results of a study with the {what} {one!r}, not {other!r}", _ELSEWHERE
            )
    if now.samples < before.samples:
        raise StoreError(
            folder,
            f"it holds {before.samples} samples, but this study has {now.samples}",
            f"give {before.samples} or more, run the folder itself, or {_ELSEWHERE}",
        )
    kept = {canonical(each) for each in now.combinations()}
    for each in before.combinations():
        text = canonical(each)
        if text not in kept:
            raise StoreError(
                folder,
                f"it holds cases that are not in this study ({text})",
                f"only add values to the table of the study, run the folder itself, or {_ELSEWHERE}",
            )
