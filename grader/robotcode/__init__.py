"""Robot code is run and judged by the robot's behavior: Java and RobotPy alike.

    file ──running──▶ java | python ──on the fakes of library──▶ bench ──▶ facts

``java`` is an interpreter for the Java of robot projects; nothing of a learner's touches the
machine. ``python`` runs RobotPy in a process that is shut in: WPILib's own where it is installed.
``library`` has one small class for each class of WPILib and of the vendors. ``bench`` turns the
mechanism, runs the tests, presses the buttons, and writes down what happened. ``running`` puts them
together. Comments are the only thing that is read.
"""
