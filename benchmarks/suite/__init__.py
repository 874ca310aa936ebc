"""The benchmark of rough contact, see docs/evidence/benchmark-suite.md: cases as data, one adapter a program."""
