"""What machine code and those who call it agree on."""

__all__ = ["APART", "HALF", "REACH", "SIDE", "WIDTH"]

WIDTH = 32  # bytes of numbers that are taken at a time, one a lane: a register of most processors
REACH = 2  # cells to either side that a sum over near ones looks at
SIDE = 8  # cells of a tile
HALF = 0  # in place of a radix: four, of which the last two are nothing
APART = 8  # counters in a line of the cache
