"""What the records of a WPILOG file belong to: entries, each a named series of one type.

Control records (entry id 0) start an entry, finish it, or change its metadata. An id is free for
another entry once it is finished, and an entry may come back under another id: its samples are
joined.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from itertools import groupby
from operator import attrgetter

import numpy as np
from numpy.typing import NDArray

from sim.formats.wpilog.control import Finish, Metadata, Start, control
from sim.formats.wpilog.records import Bytes, Fields, Numbers, Records, fields, view
from sim.log import Array

SIZES = {"double": 8, "int64": 8, "float": 4, "boolean": 1}  # [bytes] of one value
STRING = "string"
END = np.iinfo(np.int64).max  # [records] behind the last of any file
SMALL_IDS = 1 << 16  # ids below fit 16 bits, which NumPy sorts by radix
