"""Which papers an answer rests on: the references of the program, and those of one answer."""
