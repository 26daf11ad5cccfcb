"""An exercise: its folder, its mistakes, its starting file, and whether an addition is whole."""
