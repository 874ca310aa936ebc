"""With which status the program ends; nothing is imported here, so that they are known from the first moment."""

__all__ = ["BAD_INPUT", "INTERRUPTED", "MISSED", "MISTAKE", "TERMINATED"]

MISSED = 1  # an answer that did not meet its tolerance
BAD_INPUT = 2  # the same status as a misspelt option
MISTAKE = 70  # ours: what sysexits.h calls an internal error
INTERRUPTED = 130  # what a shell reports for Ctrl-C
TERMINATED = 143  # likewise for SIGTERM
