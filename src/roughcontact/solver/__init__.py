"""The solver: linear complementarity problems of contact. It takes operators and bounds, no surfaces."""
