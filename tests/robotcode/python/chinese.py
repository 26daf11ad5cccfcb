from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import Encoder, PWMSparkMax

斜率 = 0.5  # 伏每秒
阶跃 = 3.5  # 伏


class 升降机(Subsystem):
    """升降机：一个电机，一个编码器。"""

    def __init__(self):
        self.电机 = PWMSparkMax(0)
        self.编码器 = Encoder(0, 1)
        self.辨识 = SysIdRoutine(
            SysIdRoutine.Config(斜率, 阶跃, 10),
            SysIdRoutine.Mechanism(self.驱动, self.记录, self),
        )

    def 驱动(self, 电压):
        self.电机.setVoltage(电压)

    def 记录(self, 日志):
        日志.motor("升降机").voltage(self.电机.getVoltage()).position(
            self.编码器.getDistance()
        ).velocity(self.编码器.getRate())
