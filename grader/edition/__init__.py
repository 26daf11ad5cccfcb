"""The lessons as pages to read without installing anything: executed, whole, asking nobody.

notebook_execution.py  a lesson's notebook, run as a learner runs it
notebook_html.py       its cells as HTML; a widget as it is first shown
pages.py               a page for each lesson, slides of it, and the handout of all system checks
"""

from grader.edition.pages import build_pages

__all__ = ["build_pages"]
