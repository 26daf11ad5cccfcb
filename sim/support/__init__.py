"""What is no system identification: files, processes, terminals, catalogues."""
