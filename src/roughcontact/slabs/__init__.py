"""Planes dealt out by rows to the processes of a communicator."""
