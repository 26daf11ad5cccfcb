"""What one student works on: numbers drawn for them, the files made of these, their package."""
