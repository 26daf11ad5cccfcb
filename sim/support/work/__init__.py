"""Run many jobs: in child processes of this machine, or on a cluster.

A job and its result are plain data that can be pickled; the work is a function of a module. An
``Executor`` (``concurrent.futures``) takes the jobs: threads here, or a Dask cluster. Either way a
child process of the thread does the job, so one that hangs or dies costs only its own job.
"""
