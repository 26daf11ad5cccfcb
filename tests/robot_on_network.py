"""A robot on NetworkTables that publishes the runs of a log, as a program of its own.

    python robot_on_network.py PORT LOG

Each line of standard input is what to publish next: {"run": 0, "share": 1.0, "ends": true,
"clock": 10.0}, a run of the log or its first part, moved to that many seconds after the start. It
publishes what a robot program does with a SysIdRoutine: the data, then the name of the test. A
number that is never the same goes out all the time. The robot is off when its input ends.
"""

import json
import sys
import threading
import time

import ntcore

import sim

SECOND = 1e6  # [µs]
NAMES = ("VoltageVolts", "PositionMeters", "VelocityMetersPerSec")


def main(port, path):
    """Publish what is asked for."""
    runs = sim.read(path).runs
    began = ntcore.Value.makeDouble(0.0).time() / SECOND
    instance = ntcore.NetworkTableInstance.create()
    table = instance.getTable("Drive")
    signals = [table.getDoubleTopic(name).publish() for name in NAMES]
    state = table.getStringTopic("SysIdState").publish()
    heartbeat = table.getIntegerTopic("Heartbeat").publish()
    instance.startServer("", "127.0.0.1", 0, port)
    threading.Thread(target=beat, args=(heartbeat,), daemon=True).start()
    for line in sys.stdin:
        asked = json.loads(line)
        run = runs[asked["run"]]
        count = round(asked["share"] * len(run))
        clock = began + asked["clock"] - float(run.time[0])
        rows = zip(run.time[:count], run.voltage, run.position, run.velocity, strict=False)
        for moment, *values in rows:
            at = round(SECOND * (moment + clock))
            for topic, value in zip(signals, values, strict=True):
                topic.set(float(value), at)
            state.set(run.test, at + 1)
        if asked["ends"]:
            state.set("none", round(SECOND * (run.time[count - 1] + clock + 0.02)))
        instance.flush()


def beat(heartbeat):
    """Publish a number that is never the same."""
    number = 0
    while True:
        number += 1
        heartbeat.set(number)
        time.sleep(0.02)


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
