package teams;

import static edu.wpi.first.units.Units.*;

import edu.wpi.first.math.kinematics.DifferentialDriveKinematics;
import edu.wpi.first.math.kinematics.DifferentialDriveOdometry;
import edu.wpi.first.math.geometry.Rotation2d;
import edu.wpi.first.units.measure.*;
import edu.wpi.first.wpilibj.ADXRS450_Gyro;
import edu.wpi.first.wpilibj.Encoder;
import edu.wpi.first.wpilibj.RobotController;
import edu.wpi.first.wpilibj.drive.DifferentialDrive;
import edu.wpi.first.wpilibj.motorcontrol.MotorController;
import edu.wpi.first.wpilibj.motorcontrol.PWMSparkMax;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import java.util.EnumMap;
import java.util.function.Consumer;

public class ChainedConsumers extends SubsystemBase {
  enum Side { LEFT, RIGHT }

  record Gearbox(PWMSparkMax lead, PWMSparkMax follow, Encoder encoder) implements Consumer<Voltage> {
    static Gearbox create(int leadPort, int followPort, int a, int b, boolean inverted) {
      var box = new Gearbox(new PWMSparkMax(leadPort), new PWMSparkMax(followPort), new Encoder(a, b, inverted));
      box.lead.addFollower(box.follow);
      box.lead.setInverted(inverted);
      box.encoder.setDistancePerPulse(Inches.of(6).in(Meters) * Math.PI / 2048);
      return box;
    }

    @Override
    public void accept(Voltage voltage) {
      lead.setVoltage(voltage);
    }

    Voltage applied() {
      return RobotController.getMeasureBatteryVoltage().times(lead.get());
    }
  }

  private final EnumMap<Side, Gearbox> boxes = new EnumMap<>(Side.class);
  private final DifferentialDrive drive;
  private final SysIdRoutine routine;

  public ChainedConsumers() {
    boxes.put(Side.LEFT, Gearbox.create(0, 1, 0, 1, false));
    boxes.put(Side.RIGHT, Gearbox.create(2, 3, 2, 3, true));
    drive = new DifferentialDrive(boxes.get(Side.LEFT).lead()::set, boxes.get(Side.RIGHT).lead()::set);
    drive.setSafetyEnabled(false);
    Consumer<Voltage> both = boxes.get(Side.LEFT).andThen(boxes.get(Side.RIGHT));
    routine = new SysIdRoutine(
        new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
        new SysIdRoutine.Mechanism(both, this::record, this));
  }

  private void record(SysIdRoutineLog log) {
    boxes.forEach((side, box) -> log.motor("drive-" + side.name().toLowerCase())
        .voltage(box.applied())
        .linearPosition(Meters.of(box.encoder().getDistance()))
        .linearVelocity(MetersPerSecond.of(box.encoder().getRate())));
  }

  public void arcade(double x, double z) {
    drive.arcadeDrive(x, z);
  }
}
