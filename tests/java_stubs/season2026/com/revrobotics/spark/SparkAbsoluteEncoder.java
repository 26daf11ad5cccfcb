// Signatures of REVLib 2026: https://codedocs.revrobotics.com/java/com/revrobotics/spark/SparkAbsoluteEncoder.html

package com.revrobotics.spark;

import com.revrobotics.AbsoluteEncoder;

public abstract class SparkAbsoluteEncoder implements AbsoluteEncoder {}
