"""The solver: linear complementarity problems of contact. It knows operators and bounds, no surfaces."""
