"""Progress of long tasks: events of the library, listeners, and a bar for notebooks and scripts."""

from roughcontact.progress.bar import bar as bar
from roughcontact.progress.events import (
    Event as Event,
    RunningTask as RunningTask,
    listening as listening,
    task as task,
    tracked as tracked,
)

__all__ = ["Event", "RunningTask", "bar", "listening", "task", "tracked"]
