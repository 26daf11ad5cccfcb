"""Who does many jobs: this process, as many as there are cores, or the machines of a cluster.

A job and what it gives back are plain data that can travel; what does it is a function of a module.
Results come back as soon as they are there, in no order, and only a few jobs are held at a time.
"""
