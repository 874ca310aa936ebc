"""Parts of pictures: axes, ticks, units, marks, rasters."""
