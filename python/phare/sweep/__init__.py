"""Sweeps: many drives from one plan, a table and a ranking."""
