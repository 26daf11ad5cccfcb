"""A class: what was handed in, graded beside one another, kept, summed up and exported.

submissions.py     what each student handed in, and who that is
submitted_files.py the files in one folder or zip file
sorted_files.py    which exercise each of them belongs to
grading.py         one student's files -> results; where learners' code is run, it is run apart
store.py           results on disk: a run that was ended goes on where it stopped
class_grading.py   all of them, on this machine or a cluster
item_analysis.py   which question, which misconception
result_pages.py    the overview
exports/           the formats of gradebooks and of other people's systems
roster.py          who is in the class;  secret.py  what only its instructor holds
"""
