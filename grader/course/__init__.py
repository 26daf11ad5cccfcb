"""The course on this machine: its folder and files, the learner and their progress."""
