"""``sysid fit``: the command, and what it adds to a fit."""

from sim.support.lazy_package import lazy_modules

__getattr__ = lazy_modules(__name__)
