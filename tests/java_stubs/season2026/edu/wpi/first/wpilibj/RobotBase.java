// Signatures of allwpilib v2026.2.2: wpilibj/src/main/java/edu/wpi/first/wpilibj/RobotBase.java

package edu.wpi.first.wpilibj;

public abstract class RobotBase {
  public static native boolean isReal();

  public static native boolean isSimulation();
}
