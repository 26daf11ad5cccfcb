"""The examiner: checks a learner's answers and says what to do next. Knows no exercise by name."""
