package frc.robot.subsystems.drive;

import edu.wpi.first.math.geometry.Rotation2d;

/** One module: what it does, whatever its hardware is. */
public class Module {
  private final ModuleIO io;
  private final int index;

  public Module(ModuleIO io, int index) {
    this.io = io;
    this.index = index;
  }

  /** The drive gets a voltage, and the wheel is held straight. */
  public void runCharacterization(double output) {
    io.setDriveOpenLoop(output);
    io.setTurnPosition(Rotation2d.kZero);
  }
}
