"""What pictures share: axes, ticks, units, marks, rasters."""
