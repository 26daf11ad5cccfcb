"""``sysid reconcile``: the command, and its work."""

from sim.support.lazy_package import lazy_modules

__getattr__ = lazy_modules(__name__)
