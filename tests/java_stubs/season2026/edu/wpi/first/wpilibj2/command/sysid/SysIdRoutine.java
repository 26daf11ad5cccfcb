// Signatures of allwpilib v2026.2.2: wpilibNewCommands/src/main/java/edu/wpi/first/wpilibj2/command/sysid/SysIdRoutine.java

package edu.wpi.first.wpilibj2.command.sysid;

import edu.wpi.first.units.VoltageUnit;
import edu.wpi.first.units.measure.Time;
import edu.wpi.first.units.measure.Velocity;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj2.command.Command;
import edu.wpi.first.wpilibj2.command.Subsystem;
import java.util.function.Consumer;

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
    kForward,
    kReverse
  }

  public native Command quasistatic(Direction direction);

  public native Command dynamic(Direction direction);
}
