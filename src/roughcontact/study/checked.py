"""Models that check their values and raise readable errors."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from roughcontact.study.study_errors import StudyError, mistakes_of, refusal

__all__ = ["TOO_DEEP", "Checked"]

TOO_DEEP = "its values are nested too deeply to be read: use no more than two levels of lists"


class Checked(BaseModel):
    """The base of a study, of its ranges and of the parameters of cases: only known names, frozen, finite.

    Raises
    ------
    StudyError
        If a value is missing, unknown or invalid: all errors, each with its name.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    def __init__(self, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ValidationError as error:
            raise refusal(mistakes_of(error, type(self).model_fields)) from None
        except RecursionError:
            raise StudyError(TOO_DEEP) from None
