"""Pictures of logs and of gains: each with its words and its numbers. Only here is matplotlib used.

    from sim.plot import time_series
    time_series(log)                          # in a notebook: picture, words, table
    time_series(log).save("log.svg")          # in a script

Nothing here needs a screen, and nothing here keeps a state: a picture is made, and that is all.
"""

from sim.plot.acceleration import acceleration_velocity
from sim.plot.analyzer import velocity_time
from sim.plot.budget import budget
from sim.plot.charts import choices, curves, misses
from sim.plot.class_scores import score_heatmap, score_histogram
from sim.plot.ellipse import ellipses, information_map
from sim.plot.gap_bars import gap_bars
from sim.plot.gauge import gauge
from sim.plot.hold_voltage import hold_angles, hold_window
from sim.plot.interactive import live
from sim.plot.logs import time_series
from sim.plot.picture import Picture
from sim.plot.r2_vs_gain_error import r2_vs_gain_error
from sim.plot.relative_change import relative_change
from sim.plot.runway import runway
from sim.plot.table import Table
from sim.plot.timesteps import timesteps
from sim.plot.tracking_error import measure_tracking_error, tracking_error
from sim.plot.voltage_residual import plot_voltage_residual, residual_views
from sim.plot.voltage_velocity import Line, voltage_velocity

__all__ = [
    "Line",
    "Picture",
    "Table",
    "acceleration_velocity",
    "budget",
    "choices",
    "curves",
    "ellipses",
    "gap_bars",
    "gauge",
    "hold_angles",
    "hold_window",
    "information_map",
    "live",
    "measure_tracking_error",
    "misses",
    "plot_voltage_residual",
    "r2_vs_gain_error",
    "relative_change",
    "residual_views",
    "runway",
    "score_heatmap",
    "score_histogram",
    "time_series",
    "timesteps",
    "tracking_error",
    "velocity_time",
    "voltage_velocity",
]
