"""Runs Java robot code: a small interpreter over tree-sitter's tree, with values of its own.

A learner's classes become Python classes, so that they can derive from the fakes of
``grader.robotcode.library``; methods become Python functions of their variables.
"""
