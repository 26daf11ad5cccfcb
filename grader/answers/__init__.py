"""Answers that a learner hands in: their files, numbers with units, words, and known slips."""
