// Signatures of REVLib 2026: https://codedocs.revrobotics.com/java/com/revrobotics/spark/config/SparkFlexConfig.html

package com.revrobotics.spark.config;

public class SparkFlexConfig extends SparkBaseConfig {}
