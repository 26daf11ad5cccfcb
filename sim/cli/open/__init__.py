"""The page of ``sysid open``: its command, its server, its data and the logs that are open."""

from sim.support.lazy_package import lazy_modules

__getattr__ = lazy_modules(__name__)
