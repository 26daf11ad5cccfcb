"""Grading of a whole class: read submissions, grade them in parallel, store and export results.

submissions.py     what each student handed in, and who that is
submitted_files.py the files in one folder or zip file
answer_files.py    which of them are graded: one rule
identity.py        whose numbers they worked on;  roster.py  who is in the class
grading.py         one student's files -> results; where learners' code is run, it is run apart
store.py           results on disk: a run that was ended goes on where it stopped
class_grading.py   all of them, on this machine or a cluster
results.py         the results of everybody;  overrides.py  marks that an instructor sets
item_analysis.py   which question, which misconception
likeness.py        what is alike in the answers of two students
result_pages.py    the overview
exports/           the formats of gradebooks and of other people's systems
secret.py          what only the class's instructor holds
"""
