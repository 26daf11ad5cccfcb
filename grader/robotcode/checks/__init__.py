"""Right and wrong in a robot program, judged by its behavior on the bench.

Every function looks at facts and raises WrongAnswer where they show a fault; where the facts depend
on something that nobody knows, it asks. What the robot did comes first, then the line that did it.
"""
