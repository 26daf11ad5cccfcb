// Signatures of REVLib 2026: https://codedocs.revrobotics.com/java/com/revrobotics/spark/config/SparkMaxConfig.html

package com.revrobotics.spark.config;

public class SparkMaxConfig extends SparkBaseConfig {}
