"""Files of instruments, which lie beside some checkouts: their licences keep most of them out of the repository."""

from pathlib import Path

__all__ = ["NOT_HERE", "SURFACES"]

SURFACES = next(
    (
        found
        for folder in Path(__file__).resolve().parents
        if (found := folder.parent / "shared" / "data" / "surfaces").is_dir()
    ),
    None,
)
NOT_HERE = "files of real instruments are not in the repository, since licences forbid it for half of them"
