"""One laptop serves the course to browsers on its own network: nothing is installed on theirs.

    student_folders.py  a copy of the course for each student, and the codes they log in with
    jupyter_servers.py  a Jupyter server for each student
    login_page.py       the page that asks for name and code, and the queue

Where root serves, each student's server runs under a user id of its own, which alone can read its
home. Elsewhere students share one account and can read each other's files; `grade serve` says so.
"""
