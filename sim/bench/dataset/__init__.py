"""Datasets: many simulated logs, damaged on purpose, with a sealed answer key.

A spec (``spec``) becomes a plan of independent jobs (``plan``). Each job makes a log (``making``)
on any free process or machine. The files of the logs are written to a folder (``folder``), and
their ground truth to a key beside it (``key``).
"""
