// Signatures of REVLib 2026: https://codedocs.revrobotics.com/java/com/revrobotics/ResetMode.html

package com.revrobotics;

public enum ResetMode {
  kNoResetSafeParameters,
  kResetSafeParameters
}
