// Signatures of REVLib 2026: https://codedocs.revrobotics.com/java/com/revrobotics/spark/SparkBase.html

package com.revrobotics.spark;

import com.revrobotics.REVLibError;
import com.revrobotics.RelativeEncoder;
import com.revrobotics.spark.config.SparkBaseConfig;

public abstract class SparkBase extends SparkLowLevel {
  public enum ControlType {
    kDutyCycle,
    kVelocity,
    kVoltage,
    kPosition
  }

  public enum ResetMode {
    kNoResetSafeParameters,
    kResetSafeParameters
  }

  public enum PersistMode {
    kNoPersistParameters,
    kPersistParameters
  }

  public native void set(double speed);

  public native void setVoltage(double outputVolts);

  public native double get();

  public native void setInverted(boolean isInverted);

  public native boolean getInverted();

  public native void disable();

  public native void stopMotor();

  public native RelativeEncoder getEncoder();

  public native SparkAbsoluteEncoder getAbsoluteEncoder();

  public native SparkClosedLoopController getClosedLoopController();

  public native double getAppliedOutput();

  public native double getBusVoltage();

  public native double getOutputCurrent();

  public native REVLibError configure(
      SparkBaseConfig config, ResetMode resetMode, PersistMode persistMode);

  public native REVLibError configure(
      SparkBaseConfig config,
      com.revrobotics.ResetMode resetMode,
      com.revrobotics.PersistMode persistMode);
}
