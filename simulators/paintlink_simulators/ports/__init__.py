"""Places a simulated instrument can be reached at: memory, pty, TCP."""

from paintlink_simulators.ports.memory import ManualClock, MemoryPort
from paintlink_simulators.ports.operator import Operator
from paintlink_simulators.ports.pty import PtyPort
from paintlink_simulators.ports.tcp import TcpPort

__all__ = ["ManualClock", "MemoryPort", "Operator", "PtyPort", "TcpPort"]
