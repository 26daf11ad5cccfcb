package frc.robot.subsystems.drive;

import edu.wpi.first.math.geometry.Rotation2d;

/** One module, whatever its hardware is. */
public class Module {
  private final ModuleIO io;
  private final ModuleIO.ModuleIOInputs inputs = new ModuleIO.ModuleIOInputs();
  private final int index;

  public Module(ModuleIO io, int index) {
    this.io = io;
    this.index = index;
  }

  public void periodic() {
    io.updateInputs(inputs);
  }

  /** The wheel points to zero while the drive motor gets what the routine asks for. */
  public void runCharacterization(double output) {
    io.setDriveOpenLoop(output);
    io.setTurnPosition(Rotation2d.kZero);
  }

  public void stop() {
    io.setDriveOpenLoop(0.0);
    io.setTurnOpenLoop(0.0);
  }
}
