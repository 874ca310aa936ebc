"""Executors of tasks: in this process, in processes of this machine, or on a cluster."""

from roughcontact.study.executors.dask import Dask as Dask
from roughcontact.study.executors.processes import Processes as Processes
from roughcontact.study.executors.serial import Serial as Serial
