// Signatures of REVLib 2026: https://codedocs.revrobotics.com/java/com/revrobotics/AbsoluteEncoder.html

package com.revrobotics;

public interface AbsoluteEncoder {
  double getPosition();

  double getVelocity();
}
