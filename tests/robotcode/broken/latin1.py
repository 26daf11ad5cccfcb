# -*- coding: latin-1 -*-
# Geschwindigkeit für den Arm
ramp = 0.5
