"""The exit statuses of the program; this module imports nothing, so that they are available at once."""

__all__ = ["BAD_INPUT", "INTERRUPTED", "MISSED", "MISTAKE", "TERMINATED"]

MISSED = 1  # an answer that did not meet its tolerance
BAD_INPUT = 2  # the same status as a misspelt option
MISTAKE = 70  # a defect of ours; sysexits.h: an internal software error
INTERRUPTED = 130  # what a shell reports for Ctrl-C
TERMINATED = 143  # likewise for SIGTERM
