"""Pictures of logs and of gains, each with a description and a table of its numbers.

Only this package uses matplotlib.

    from sim.plot import plot_time_series
    plot_time_series(log)                          # in a notebook: picture, description, table
    plot_time_series(log).save("log.svg")          # in a script

Nothing here needs a screen, and no function keeps state between calls.
"""

from sim.plot.acceleration import plot_acceleration_velocity
from sim.plot.gain_tables import tabulate_fits, tabulate_gains
from sim.plot.gap_bars import plot_gap_bars
from sim.plot.logs import plot_time_series
from sim.plot.picture import Picture
from sim.plot.table import Table
from sim.plot.voltage_residual import make_residual_views, plot_voltage_residual
from sim.plot.voltage_velocity import Line, plot_voltage_velocity

__all__ = [
    "Line",
    "Picture",
    "Table",
    "make_residual_views",
    "plot_acceleration_velocity",
    "plot_gap_bars",
    "plot_time_series",
    "plot_voltage_residual",
    "plot_voltage_velocity",
    "tabulate_fits",
    "tabulate_gains",
]
