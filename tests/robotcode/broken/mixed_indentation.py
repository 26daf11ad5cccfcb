class Mixed:
    def a(self):
        x = 1
	if x:
	    y = 2
