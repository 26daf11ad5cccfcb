"""What a learner uses in a notebook: submit answers, answer questions."""
