"""The page of ``sysid open``: its server, its data and the logs that are open."""
