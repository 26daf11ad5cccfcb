"""Mutation testing of the graders: right answers with one mistake put into each."""
