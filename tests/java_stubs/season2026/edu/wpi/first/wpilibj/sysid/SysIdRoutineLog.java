// Signatures of allwpilib v2026.2.2: wpilibj/src/main/java/edu/wpi/first/wpilibj/sysid/SysIdRoutineLog.java

package edu.wpi.first.wpilibj.sysid;

import edu.wpi.first.units.measure.Angle;
import edu.wpi.first.units.measure.AngularVelocity;
import edu.wpi.first.units.measure.Current;
import edu.wpi.first.units.measure.Distance;
import edu.wpi.first.units.measure.LinearVelocity;
import edu.wpi.first.units.measure.Voltage;

public class SysIdRoutineLog {
  public SysIdRoutineLog(String logName) {}

  public enum State {
    kQuasistaticForward,
    kQuasistaticReverse,
    kDynamicForward,
    kDynamicReverse,
    kNone
  }

  public final class MotorLog {
    private MotorLog() {}

    public native MotorLog value(String name, double value, String unit);

    public native MotorLog voltage(Voltage voltage);

    public native MotorLog linearPosition(Distance position);

    public native MotorLog angularPosition(Angle position);

    public native MotorLog linearVelocity(LinearVelocity velocity);

    public native MotorLog angularVelocity(AngularVelocity velocity);

    public native MotorLog current(Current current);
  }

  public native MotorLog motor(String motorName);

  public native void recordState(State state);
}
