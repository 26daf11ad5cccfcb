// Signatures of REVLib 2026: https://codedocs.revrobotics.com/java/com/revrobotics/PersistMode.html

package com.revrobotics;

public enum PersistMode {
  kNoPersistParameters,
  kPersistParameters
}
