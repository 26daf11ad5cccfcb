// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): commandsv3/src/main/java/org/wpilib/command3/sysid/SysIdRoutine.java

package org.wpilib.command3.sysid;

import java.util.function.Consumer;
import org.wpilib.command3.Command;
import org.wpilib.command3.Mechanism;
import org.wpilib.sysid.SysIdRoutineLog;
import org.wpilib.units.VoltageUnit;
import org.wpilib.units.measure.Time;
import org.wpilib.units.measure.Velocity;
import org.wpilib.units.measure.Voltage;

public class SysIdRoutine extends SysIdRoutineLog {
  public SysIdRoutine(Config config, SysIdMechanism mechanism) {
    super(null);
  }

  public static class Config {
    public static final Velocity<VoltageUnit> DEFAULT_RAMP_RATE = null;
    public static final Voltage DEFAULT_STEP_VOLTAGE = null;
    public static final Time DEFAULT_TIMEOUT = null;

    public Config(
        Velocity<VoltageUnit> rampRate,
        Voltage stepVoltage,
        Time timeout,
        Consumer<State> recordState) {}

    public static native Config useDataLog(
        Velocity<VoltageUnit> rampRate, Voltage stepVoltage, Time timeout);

    public static native Config defaults();
  }

  public static class SysIdMechanism {
    public SysIdMechanism(
        Consumer<Voltage> drive,
        Consumer<SysIdRoutineLog> log,
        Mechanism mechanism,
        String name) {}

    public SysIdMechanism(
        Consumer<Voltage> drive, Consumer<SysIdRoutineLog> log, Mechanism mechanism) {}
  }

  public enum Direction {
    FORWARD,
    REVERSE
  }

  public native Command quasistatic(Direction direction);

  public native Command dynamic(Direction direction);
}
