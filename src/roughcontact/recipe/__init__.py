"""A job as one value: what is pressed, how, by which loads, and what is asked of the contact."""
