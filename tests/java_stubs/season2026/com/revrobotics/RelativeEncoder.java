// Signatures of REVLib 2026: https://codedocs.revrobotics.com/java/com/revrobotics/RelativeEncoder.html

package com.revrobotics;

public interface RelativeEncoder {
  double getPosition();

  double getVelocity();
}
