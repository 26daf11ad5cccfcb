"""An exercise: its folder, its mistakes, its starting file, and the check of a new one."""
