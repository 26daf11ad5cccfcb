"""The formats of logs, one module each."""
