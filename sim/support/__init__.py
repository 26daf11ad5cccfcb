"""Files, processes, terminals and catalogues: nothing about system identification."""
