"""What machine code and those who call it agree on."""

__all__ = [
    *("APART", "CHUNK", "HALF", "NEAR_ROWS", "NEVER", "PHASES"),
    *("REACH", "ROUNDINGS", "SIDE", "WIDTH"),
]

WIDTH = 32  # bytes of numbers that are taken at a time, one a lane: a register of most processors
REACH = 2  # cells to either side that a sum over near ones looks at
SIDE = 8  # cells of a tile
NEAR_ROWS = 3 * SIDE * (SIDE + 2 * REACH)  # cells that the sums over near cells of a tile look at
HALF = 0  # in place of a radix: four, of which the last two numbers are zero
NEVER = -1e30  # residual of a cell that never comes into contact
CHUNK = 4  # registers of sums that are filled at a time
APART = 8  # counters in a line of the cache
PHASES = 3  # of a kernel at most, whose work threads share
ROUNDINGS = 8  # units in the last place: a pressure that several steps took to zero is no larger
