package frc.robot.subsystems;

import edu.wpi.first.math.controller.ArmFeedforward;
import edu.wpi.first.math.controller.ElevatorFeedforward;
import edu.wpi.first.math.controller.SimpleMotorFeedforward;
import edu.wpi.first.wpilibj2.command.SubsystemBase;

/** A mechanism that was characterized, and that should follow a velocity. */
public class ExampleMechanism extends SubsystemBase {
  /** What SysId found out. Measured with a fresh battery; measure again when the mechanism changes. */
  public static final class CharacterizationConstants {
    // TODO: 1. One constant for each gain that the analyzer shows, kP too. Next to each, a
    //       comment with its unit. Next to kP, also write how far you trust this number.
  }

  // TODO: 2. The feedforward, made from these constants. Use the class that fits your mechanism.
  //       given.toml gives the unit of its velocities under [robot]. Or put the gains into the
  //       motor controller: new Slot0Configs() (Phoenix 6) or new FeedForwardConfig() (REVLib).
}
