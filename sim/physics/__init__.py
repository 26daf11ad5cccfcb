"""The model of a mechanism: gains, effects, motors, battery, and the engine that simulates them."""
