"""One laptop serves the course to browsers on its own network: nothing is installed on theirs.

    homes.py     a copy of the course for each student, which stays; and the codes they come in with
    rooms.py     a Jupyter server for each student, started when they come, ended when they go
    door.py      the page where one says who one is

Students share the laptop's account: they are kept apart by their codes and tokens, not by its
operating system. Do not serve from a machine that holds a class's secret or its answers.
"""
