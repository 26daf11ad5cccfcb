// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): commandsv2/src/main/java/org/wpilib/command2/sysid/SysIdRoutine.java

package org.wpilib.command2.sysid;

import java.util.function.Consumer;
import org.wpilib.command2.Command;
import org.wpilib.command2.Subsystem;
import org.wpilib.sysid.SysIdRoutineLog;
import org.wpilib.units.VoltageUnit;
import org.wpilib.units.measure.Time;
import org.wpilib.units.measure.Velocity;
import org.wpilib.units.measure.Voltage;

public class SysIdRoutine extends SysIdRoutineLog {
  public SysIdRoutine(Config config, Mechanism mechanism) {
    super(null);
  }

  public static class Config {
    public Config(
        Velocity<VoltageUnit> rampRate,
        Voltage stepVoltage,
        Time timeout,
        Consumer<State> recordState) {}

    public Config(Velocity<VoltageUnit> rampRate, Voltage stepVoltage, Time timeout) {}

    public Config() {}
  }

  public static class Mechanism {
    public Mechanism(
        Consumer<Voltage> drive, Consumer<SysIdRoutineLog> log, Subsystem subsystem, String name) {}

    public Mechanism(Consumer<Voltage> drive, Consumer<SysIdRoutineLog> log, Subsystem subsystem) {}
  }

  public enum Direction {
    FORWARD,
    REVERSE
  }

  public native Command quasistatic(Direction direction);

  public native Command dynamic(Direction direction);
}
