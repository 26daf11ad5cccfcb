"""Run many jobs: in this process, on all cores, or on a cluster.

A job and what it gives back are plain data that can travel; what does it is a function of a module.
Results come back as soon as they are there, in no order, and only a few jobs are held at a time.
"""
