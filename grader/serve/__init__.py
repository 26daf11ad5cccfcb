"""One laptop serves the course to browsers on its own network: nothing is installed on theirs.

    homes.py     a copy of the course for each student, which stays; and the codes they come in with
    rooms.py     a Jupyter server for each student, started when they come, ended when they go
    door.py      the page where one says who one is

Where root serves, each student's server runs under a user id of its own, which alone can read its
home. Elsewhere students share one account and can read each other's files; `grade serve` says so.
"""
