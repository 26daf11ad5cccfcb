"""Run many jobs: in this process, on all cores, or on a cluster.

A job and its result are plain data that can be pickled; the work is a function of a module. Results
come in the order in which jobs finish, and only a few jobs are submitted at a time.
"""
