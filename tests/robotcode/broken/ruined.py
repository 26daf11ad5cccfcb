class Ruined:
    def __init__(self):
    self.motor = None
