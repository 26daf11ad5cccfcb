"""Pictures of logs and of gains: each with its words and its numbers. Only here is matplotlib used.

    from sim.plot import time_series
    time_series(log)                          # in a notebook: picture, words, table
    time_series(log).save("log.svg")          # in a script

Nothing here needs a screen, and nothing here keeps a state: a picture is made, and that is all.
"""

from sim.plot.acceleration import acceleration_velocity
from sim.plot.analyzer import velocity_time
from sim.plot.badges import badges
from sim.plot.budget import budget
from sim.plot.change import change
from sim.plot.charts import choices, curves, misses
from sim.plot.chase import chase, miss
from sim.plot.clock import timesteps
from sim.plot.ellipse import ellipses, information_map
from sim.plot.gap_bars import gap_bars
from sim.plot.gauge import gauge
from sim.plot.hold import hold_angles, hold_window
from sim.plot.live import live
from sim.plot.logs import time_series
from sim.plot.marks import heat, spread
from sim.plot.microscope import microscope, views
from sim.plot.picture import Picture
from sim.plot.ramp import Line, voltage_velocity
from sim.plot.runway import runway
from sim.plot.table import Table

__all__ = [
    "Line",
    "Picture",
    "Table",
    "acceleration_velocity",
    "badges",
    "budget",
    "change",
    "chase",
    "choices",
    "curves",
    "ellipses",
    "gap_bars",
    "gauge",
    "heat",
    "hold_angles",
    "hold_window",
    "information_map",
    "live",
    "microscope",
    "miss",
    "misses",
    "runway",
    "spread",
    "time_series",
    "timesteps",
    "velocity_time",
    "views",
    "voltage_velocity",
]
