"""What standards allow of the shaft's vibration at a bearing, peak to peak, m, at a speed in rpm."""

from math import sqrt

#: Zones of ISO 7919-3 (1996): upper limits of A, B and C in µm, times the root of the speed in rpm.
ZONES = {"A": 4800, "B": 9000, "C": 13200}


def of_api_617(speed_rpm: float) -> float:
    """The limit of API 617 (7th edition, 2002) in tests of a new machine: 25.4 µm, less above 12000 rpm."""
    return 25.4e-6 * min(1.0, sqrt(12000 / speed_rpm))


def zone(size: float, speed_rpm: float) -> str:
    """The zone of ISO 7919-3: A as new machines, B for long operation, C for a time alone, D damages."""
    return next((own for own, limit in ZONES.items() if size <= 1e-6 * limit / sqrt(speed_rpm)), "D")
