"""The processes of the page: server, sessions, workers."""
