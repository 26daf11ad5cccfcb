"""What prepares a machine: start, doctor, JupyterHub."""
