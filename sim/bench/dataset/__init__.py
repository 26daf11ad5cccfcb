"""Datasets: many simulated logs, damaged on purpose, with a sealed answer key.

A spec (``spec``) becomes a plan of jobs that know nothing of one another (``plan``), each job a
log (``making``) on whichever process or machine is free (``workers``), each log whole files in a
folder (``folder``), and what is true of them a key beside it (``key``).
"""
