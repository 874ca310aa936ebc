"""What was measured of one surface or joint: maps and profiles together, tables of stiffness."""
