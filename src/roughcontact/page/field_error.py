"""An error that belongs to one field of the page, beside which it is shown."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

from roughcontact.files.file_errors import ReadError
from roughcontact.files.own_errors import is_ours

__all__ = ["FieldError", "at_field"]


class FieldError(ValueError):
    """What is wrong, and the field of the page that mends it; its cause is the error itself."""

    def __init__(self, field: str, error: ValueError) -> None:
        super().__init__(str(error))
        self.field = field
        self.error = error


@contextlib.contextmanager
def at_field(field: str) -> Iterator[None]:
    """Say of an error that is raised inside to which field it belongs; a reader's error names its fields itself."""
    try:
        yield
    except (FieldError, ReadError):
        raise
    except ValueError as error:
        if not is_ours(error):
            raise
        raise FieldError(field, error) from error
