"""What a check gives: points, the misconception behind a wrong answer, and what it would do."""
