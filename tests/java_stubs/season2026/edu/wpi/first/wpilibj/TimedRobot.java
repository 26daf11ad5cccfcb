// Signatures of allwpilib v2026.2.2: wpilibj/src/main/java/edu/wpi/first/wpilibj/TimedRobot.java

package edu.wpi.first.wpilibj;

public class TimedRobot extends RobotBase {}
