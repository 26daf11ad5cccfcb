"""Robot programs on a simulated robot: what they did, as facts.

``simulation`` turns the motors' shafts and runs the loop; ``routine_run`` runs the tests of a
SysIdRoutine, ``button_run`` presses the buttons, ``gains_run`` looks at gains. A program is a
subject: ``java_subject`` interprets Java here, ``grader.robotcode.python`` runs RobotPy in a
process of its own.
"""
