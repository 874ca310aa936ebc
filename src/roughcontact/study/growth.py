"""Whether a study continues what a folder holds."""

from __future__ import annotations

from pathlib import Path

from roughcontact.study.cases import find_case
from roughcontact.study.key import canonical
from roughcontact.study.study import Study
from roughcontact.study.study_errors import StoreError

__all__ = ["require_growth"]

_ELSEWHERE = "choose another folder for this one"


def require_growth(folder: Path, before: Study, now: Study) -> None:
    """Refuse a study that is another than `before`, or less of it.

    Raises
    ------
    StoreError
        If name, case or seed differ, or if samples or combinations are gone.
    """
    for what, one, other in (
        ("name", before.name, now.name),
        ("case", find_case(before.case).name, find_case(now.case).name),
        ("seed", before.seed, now.seed),
    ):
        if one != other:
            raise StoreError(folder, f"it holds a study with the {what} {one!r}, not {other!r}", _ELSEWHERE)
    if now.samples < before.samples:
        raise StoreError(
            folder,
            f"it holds {before.samples} samples, and this study has {now.samples}",
            f"give {before.samples} or more, run the folder itself, or {_ELSEWHERE}",
        )
    kept = {canonical(each) for each in now.combinations()}
    for each in before.combinations():
        text = canonical(each)
        if text not in kept:
            raise StoreError(
                folder,
                f"it holds cases that this study has not ({text})",
                f"add to its table and leave what is there, run the folder itself, or {_ELSEWHERE}",
            )
