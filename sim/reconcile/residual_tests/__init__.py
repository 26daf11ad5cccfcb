"""Tests of what a model leaves that is not noise."""
