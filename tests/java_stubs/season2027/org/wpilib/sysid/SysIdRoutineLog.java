// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): wpilibj/src/main/java/org/wpilib/sysid/SysIdRoutineLog.java

package org.wpilib.sysid;

import org.wpilib.units.measure.Angle;
import org.wpilib.units.measure.AngularVelocity;
import org.wpilib.units.measure.Current;
import org.wpilib.units.measure.Distance;
import org.wpilib.units.measure.LinearVelocity;
import org.wpilib.units.measure.Voltage;

public class SysIdRoutineLog {
  public SysIdRoutineLog(String logName) {}

  public enum State {
    QUASISTATIC_FORWARD,
    QUASISTATIC_REVERSE,
    DYNAMIC_FORWARD,
    DYNAMIC_REVERSE,
    NONE
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
