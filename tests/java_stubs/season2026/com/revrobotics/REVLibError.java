// Signatures of REVLib 2026: https://codedocs.revrobotics.com/java/com/revrobotics/REVLibError.html

package com.revrobotics;

public enum REVLibError {
  kOk
}
