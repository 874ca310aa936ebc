"""Samples of an ensemble together: means, scatter, errors, common forces, and power laws with their intervals."""

from types import ModuleType as _Module

from roughcontact.statistics.averages import (
    averages as averages,
    combinations as combinations,
    sample_dimensions as sample_dimensions,
)
from roughcontact.statistics.common_forces import on_common as on_common
from roughcontact.statistics.fit import fit_power_laws as fit_power_laws, law_at as law_at
from roughcontact.statistics.fit_window import (
    force_window as force_window,
    resolved_window as resolved_window,
)
from roughcontact.statistics.samples import (
    count as count,
    geometric_mean as geometric_mean,
    mean as mean,
    scatter as scatter,
    standard_deviation as standard_deviation,
    standard_error as standard_error,
    summary as summary,
)

__all__ = [
    name for name, each in globals().items() if not (name.startswith("_") or isinstance(each, _Module))
]
