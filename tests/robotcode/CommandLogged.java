import static edu.wpi.first.units.Units.*;

public class CommandLogged extends SubsystemBase {
  private final VictorSP motor = new VictorSP(0);
  private final Encoder encoder = new Encoder(0, 1);
  private double volts;

  private void setVolts(double volts) {
    this.volts = volts;
    motor.setVoltage(volts);
  }

  private final SysIdRoutine routine =
      new SysIdRoutine(
          new SysIdRoutine.Config(
              Millivolts.of(500).per(Second), Volts.of(3).plus(Volts.of(0.5)), Minutes.of(1).div(6)),
          new SysIdRoutine.Mechanism(
              v -> setVolts(v.in(Volts)),
              log ->
                  log.motor("intake")
                      .voltage(Volts.of(volts))
                      .angularPosition(Rotations.of(encoder.getDistance()))
                      .angularVelocity(RotationsPerSecond.of(encoder.getRate())),
              this));
}
