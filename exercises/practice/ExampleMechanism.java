package frc.robot.subsystems;

import edu.wpi.first.math.controller.ArmFeedforward;
import edu.wpi.first.math.controller.ElevatorFeedforward;
import edu.wpi.first.math.controller.SimpleMotorFeedforward;
import edu.wpi.first.wpilibj2.command.SubsystemBase;

/** A mechanism that was characterized, and that shall follow a velocity. */
public class ExampleMechanism extends SubsystemBase {
  /** What SysId found out. Measured with a fresh battery; measure again when the mechanism changes. */
  public static final class CharacterizationConstants {
    // TODO: 1. One constant for each gain that the analyzer shows, kP among them. Beside each, a
    //       comment with its unit. Beside kP, also say how far this number can be trusted.
  }

  // TODO: 2. The feedforward, made of these constants. Take the class that fits your mechanism.
  //       Its velocities come in the unit that given.toml tells under [robot].
}
