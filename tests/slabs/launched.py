"""Processes started by a launcher of MPI jobs, where there is one."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

LAUNCHER = shutil.which(
    "mpiexec", path=f"{Path(sys.executable).parent}{os.pathsep}{os.environ.get('PATH', '')}"
)
# Open MPI is asked to run more processes than there are cores, and in containers as root.
ASKED = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
    "OMP_NUM_THREADS": "1",
}


def launch(processes, *arguments):
    """Run Python with these arguments on so many processes, and return what became of them."""
    command = [LAUNCHER, "-n", str(processes), sys.executable, *arguments]
    return subprocess.run(
        list(map(str, command)), env=os.environ | ASKED, capture_output=True, text=True, timeout=300
    )
