"""The package and all files of tests can be imported where the names of POSIX are absent, as on Windows."""

import subprocess
import sys
from pathlib import Path

import pytest


@pytest.mark.slow
def test_every_module_and_every_test_is_imported_without_the_names_of_posix(tmp_path):
    """The program sees what it looks for: of three more files, two ask for such a name as they are imported."""
    asking = {
        "test_signal.py": "import signal\nNUMBERS = [signal.SIGINT, signal.SIGKILL]",
        "test_limits.py": "import resource",
        "test_later.py": "import os\ndef test_fork():\n    os.fork()",
    }
    for name, text in asking.items():
        (tmp_path / name).write_text(text)
    program = Path(__file__).with_name("without_posix.py")
    command = [sys.executable, program, *(tmp_path / name for name in asking)]
    answer = subprocess.run(command, capture_output=True, text=True, check=False)
    assert answer.stderr == ""
    assert answer.stdout.splitlines() == [
        f"{tmp_path / 'test_signal.py'}: AttributeError: module 'signal' has no attribute 'SIGKILL'",
        f"{tmp_path / 'test_limits.py'}: ModuleNotFoundError: import of resource halted; None in sys.modules",
    ]
    assert answer.returncode == 1
