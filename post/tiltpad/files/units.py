"""Units: those of the input, and those of the pictures; SI values are converted here alone."""

from collections.abc import Sequence
from math import pi
from typing import NamedTuple

import numpy as np

from tiltpad.files.archive import Archive


class Shown(NamedTuple):
    """A quantity in a picture: value in SI units times `factor`, in `unit`."""

    text: str
    factor: float
    unit: str

    @property
    def label(self) -> str:
        return f"{self.text} ({self.unit})" if self.unit else self.text


SHOWN = {
    "time": Shown("time", 1, "s"),
    "shaft_angle": Shown("shaft angle", 1, "rad"),
    "speed": Shown("speed", 30 / pi, "rpm"),
    "frequency": Shown("frequency", 1, "Hz"),
    "amplitude": Shown("amplitude", 1e6, "µm"),
    "size": Shown("peak to peak", 1e6, "µm"),
    "sliding_velocity": Shown("sliding velocity", 1e3, "mm/s"),
    "friction_coefficient": Shown("friction coefficient", 1, ""),
    "journal_y": Shown("journal $y$", 1e6, "µm"),
    "journal_z": Shown("journal $z$", 1e6, "µm"),
    "journal_vy": Shown("journal velocity, $y$", 1e3, "mm/s"),
    "journal_vz": Shown("journal velocity, $z$", 1e3, "mm/s"),
    "pad_tilt": Shown("tilt", 1e3, "mrad"),
    "pad_tilt_rate": Shown("tilt rate", 1e3, "mrad/s"),
    "pivot_deflection": Shown("pivot_deflection", 1e6, "µm"),
    "pivot_deflection_rate": Shown("pivot deflection rate", 1e3, "mm/s"),
    "bristle_deflection": Shown("bristle deflection", 1e6, "µm"),
    "pad_pitch": Shown("pad pitch", 1e3, "mrad"),
    "pad_pitch_rate": Shown("pad pitch rate", 1e3, "mrad/s"),
    "pad_yaw": Shown("pad yaw", 1e3, "mrad"),
    "pad_yaw_rate": Shown("pad yaw rate", 1e3, "mrad/s"),
    "bristle_deflection_pitch": Shown("bristle deflection, pitch", 1e6, "µm"),
    "bristle_deflection_yaw": Shown("bristle deflection, yaw", 1e6, "µm"),
    "friction_moment_pitch": Shown("friction moment, pitch", 1, "N m"),
    "friction_moment_yaw": Shown("friction moment, yaw", 1, "N m"),
    "journal_moment_y": Shown("moment on the journal, vertical slope", 1, "N m"),
    "journal_moment_z": Shown("moment on the journal, horizontal slope", 1, "N m"),
    "journal_slope_y": Shown("slope of the shaft in the bearing, vertical", 1e3, "mrad"),
    "journal_slope_z": Shown("slope of the shaft in the bearing, horizontal", 1e3, "mrad"),
    "mean_moment_y": Shown("mean moment, vertical slope", 1, "N m"),
    "mean_moment_z": Shown("mean moment, horizontal slope", 1, "N m"),
    "start_film_thickness": Shown("minimum film thickness, end of lower x", 1e6, "µm"),
    "end_film_thickness": Shown("minimum film thickness, end of higher x", 1e6, "µm"),
    "max_pressure_axial": Shown("axial place of the maximum pressure", 1e3, "mm"),
    "pivot_load": Shown("pivot load", 1e-3, "kN"),
    "friction_moment": Shown("friction moment", 1, "N m"),
    "work": Shown("work", 1e3, "mJ"),
    "power": Shown("power", 1e3, "mW"),
    "share": Shown("share", 100, "%"),
    "number": Shown("number", 1, ""),
    "film_force_tangential": Shown("film force, tangential", 1e-3, "kN"),
    "film_force_radial": Shown("film force, radial", 1e-3, "kN"),
    "min_film_thickness": Shown("minimum film thickness", 1e6, "µm"),
    "max_pressure": Shown("maximum pressure", 1e-6, "MPa"),
    "asperity_force": Shown("asperity force", 1e-3, "kN"),
    "pressure": Shown("film pressure", 1e-6, "MPa"),
    "phi": Shown("angle from pivot", 180 / pi, "deg"),
    "orbit_size": Shown("orbit, peak to peak", 1e6, "µm"),
    "stick_fraction": Shown("share of time that pivots stick", 100, "%"),
    "power_loss": Shown("power loss", 1e-3, "kW"),
    "temperature": Shown("temperature", 1, "°C"),
    "viscosity": Shown("viscosity", 1e3, "mPa s"),
    "period": Shown("period", 1e3, "ms"),
    "multiplier_real": Shown("multiplier, real part", 1, ""),
    "multiplier_imag": Shown("multiplier, imaginary part", 1, ""),
    "stiffness": Shown("stiffness", 1e-6, "MN/m"),
    "damping": Shown("damping", 1e-3, "kN s/m"),
    "damping_ratio": Shown("damping ratio", 100, "%"),
    "log_decrement": Shown("logarithmic decrement", 1, ""),
    "least_damping_ratio": Shown("least damping ratio", 100, "%"),
    "rotor_damping_ratio": Shown("damping ratio of the rotor", 100, "%"),
    "pads_damping_ratio": Shown("damping ratio of the pads", 100, "%"),
    "threshold_rpm": Shown("threshold speed of stability", 1, "rpm"),
    "axial": Shown("axial position", 1e3, "mm"),
}

#: Units of files, with the factor and unit in which they are shown.
UNITS_SHOWN = {
    **{"m": (1e6, "µm"), "rad": (1e3, "mrad"), "N": (1e-3, "kN"), "Pa": (1e-6, "MPa"), "W": (1e-3, "kW")},
    **{"J": (1e3, "mJ"), "m^3/s": (6e4, "l/min"), "rad/s": (30 / pi, "rpm"), "degC": (1, "°C")},
    **{"Pa s": (1e3, "mPa s"), "m/s": (1e3, "mm/s"), "1": (1, "")},
}
#: How names of angles end that are shown in degrees.
IN_DEGREES = ("_angle", "_phase")

#: A thousandth of a unit, for values that are small in it.
THOUSANDTH = {
    **{"kN": "N", "N": "mN", "N m": "mN m", "mN m": "µN m", "mJ": "µJ", "µJ": "nJ", "nJ": "pJ"},
    **{"kW": "W", "W": "mW", "mW": "µW", "µW": "nW", "MPa": "kPa", "kPa": "Pa", "µm": "nm", "nm": "pm"},
    **{"mrad": "µrad", "µrad": "nrad", "mrad/s": "µrad/s", "mm/s": "µm/s", "µm/s": "nm/s"},
    **{"MN/m": "kN/m", "kN/m": "N/m", "kN s/m": "N s/m"},
}

#: Units of the input variables by name. Others are pure numbers, or their names end in _rpm, _deg or _hz.
UNITS = {
    **{"specific_heat": "J/(kg K)", "cross_stiffness": "N/m"},
    **{"mass": "kg", "unbalance": "kg m", "inertia": "kg m²", "characteristic_load": "N", "static_load": "N"},
    **{"balance_grade": "mm/s", "gravity": "m/s²", "viscosity": "Pa s"},
    **dict.fromkeys(("supply_temperature", "shaft_temperature", "reference_temperature"), "°C"),
    **dict.fromkeys(("clearance_temperature", "housing_temperature", "temperature"), "°C"),
    **dict.fromkeys(("shaft_expansion", "housing_expansion", "expansion"), "1/K"),
    **{"at_temperature": "°C", "temperature_exponent": "1/K", "reference_viscosity": "Pa s"},
    **{"kinematic_viscosity": "m²/s", "density_at_15": "kg/m³", "density_slope": "kg/(m³ K)"},
    **{"conductivity": "W/(m K)", "back_coefficient": "W/(m² K)", "back_temperature": "°C"},
    **dict.fromkeys(("duration", "start_time", "max_step", "checkpoint_seconds", "internal_damping"), "s"),
    **dict.fromkeys(("supply_pressure", "ambient_pressure", "cavitation_pressure"), "Pa"),
    **dict.fromkeys(("young_modulus", "elastic_modulus"), "Pa"),
    **dict.fromkeys(("radius_difference", "socket_radius", "journal_radius", "axial_length"), "m"),
    **dict.fromkeys(("machined_clearance", "assembled_clearance", "pivot_distance"), "m"),
    **{"roughness": "m", "wear_coefficient": "m³/(N m)", "groove_volume": "m³"},
    **{"centre_tangential": "m", "centre_radial": "m", "density": "kg/m³", "thickness": "m"},
    **{"inertia_pitch": "kg m²", "inertia_yaw": "kg m²", "pivot_axial_offset": "m", "slope": "rad"},
    "misalignment": "rad",
    **{"journal": "m", "journal_velocity": "m/s", "pad_tilt": "rad", "skew": "rad", "pad_tilt_rate": "rad/s"},
    **{"pivot_deflection": "m", "pivot_deflection_rate": "m/s", "pad_yaw": "rad", "pad_yaw_rate": "rad/s"},
    **{"pad_pitch": "rad", "pad_pitch_rate": "rad/s"},
    **dict.fromkeys(("offset", "length", "contact_length", "diameter", "bore", "displacement"), "m"),
    **{"polar_inertia": "kg m²", "diametral_inertia": "kg m²", "moment": "kg m", "force": "N"},
    **{"amplitude": "N", "start": "s", "end": "s", "position": "m"},
    **{"stiffness": "N/m", "rotational_stiffness": "N m/rad", "damping": "N s/m"},
    **{"frequency": "Hz", "damp_above": "Hz", "power": "W"},
    **dict.fromkeys(("suction_density", "discharge_density"), "kg/m³"),
    **dict.fromkeys(("width", "radius", "clearance", "clearance_change", "close_clearance"), "m"),
    **dict.fromkeys(("critical_velocity", "stribeck_velocity"), "m/s"),
    **{"decay": "s/m", "bristle_stiffness": "1/m", "bristle_damping": "s/m", "viscous_coefficient": "s/m"},
}
#: Units of variables whose name another group has with another unit.
UNITS_BY_GROUP = {"branch%max_step": ""}


def literal(text: str) -> str:
    """A text that is not the package's own, for a picture: no dollar sign in it starts a formula."""
    return text.replace("$", r"\$")


def named(name: str) -> tuple[str, str]:
    """Text and unit (may be empty) of "group%name"."""
    if name in UNITS_BY_GROUP:
        return name.split("%")[-1].replace("_", " "), UNITS_BY_GROUP[name]
    name = name.split("%")[-1]
    for ending, unit in (("_deg", "deg"), ("_rpm", "rpm"), ("_hz", "Hz")):
        if name.endswith(ending):
            return name.removesuffix(ending).replace("_", " "), unit
    return name.replace("_", " "), UNITS.get(name, "")


def shown(text: str, unit: str, values: Sequence[float] | np.ndarray) -> Shown:
    """The unit in which values of an input variable are shown: µm for lengths up to a millimetre, mrad for
    angles in rad up to 0.01."""
    largest = np.nanmax(np.abs(values), initial=0)
    if unit == "m" and largest <= 1e-3:
        return Shown(text, 1e6, "µm")
    if unit == "rad" and largest <= 1e-2:
        return Shown(text, 1e3, "mrad")
    return Shown(text, 1, "" if unit == "1" else unit)


def described(file: Archive, name: str, quantity: str = "") -> Shown:
    """How a dataset is shown: as the quantity of this name (or its own), else as its file describes it."""
    own = name.rpartition("/")[2]
    if known := SHOWN.get(quantity or own):
        return known
    unit, text = literal(file.about(name, "units")), literal(file.about(name, "long_name") or own)
    if unit == "1" and text.startswith("share "):
        return Shown(text, 100, "%")
    return Shown(text, *((180 / pi, "deg") if own.endswith(IN_DEGREES) else UNITS_SHOWN.get(unit, (1, unit))))


def fitted(own: Shown, values: Sequence[float] | np.ndarray) -> Shown:
    """A quantity in its unit, or in a smaller one where the largest of the values is below 0.01 in it."""
    largest = np.nanmax(np.abs(values), initial=0)
    while 0 < own.factor * largest < 0.01 and own.unit in THOUSANDTH:
        own = Shown(own.text, 1e3 * own.factor, THOUSANDTH[own.unit])
    return own


def digits(value: float, count: int = 4) -> str:
    """A number with this number of digits, without an exponent unless it is very small (9.86×10⁻⁶)."""
    if value == 0 or not np.isfinite(value):
        return "0" if value == 0 else "–"
    if abs(value) >= 10 ** (count - 1):
        return f"{value:.0f}"
    if abs(value) < 1e-4:
        mantissa, exponent = f"{value:.2e}".split("e")
        return f"{mantissa}×10{str(int(exponent)).translate(RAISED)}"
    return f"{value:#.{count}g}".rstrip(".")


RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def numbers(shown: Shown, values: Sequence[float] | np.ndarray, count: int = 4) -> list[str]:
    """Values in a unit, with this number of digits; those that are nothing beside the largest with its
    decimals."""
    own = [shown.factor * float(each) for each in values]
    largest = max((abs(each) for each in own if np.isfinite(each)), default=0.0)
    places = len(digits(largest, count).partition(".")[2])
    slight = [0 < abs(each) < 10 ** (1 - count) * largest for each in own]
    # + 0 takes the sign from a 0
    known = zip(own, slight, strict=True)
    return [f"{round(each, places) + 0:.{places}f}" if few else digits(each, count) for each, few in known]


def in_words(quantity: str, values: Sequence[float] | np.ndarray) -> str:
    """Values with their unit: "2.38, 2.99 mJ"; of many values the lowest and the highest."""
    shown = fitted(SHOWN[quantity], values)
    if len(values) > 4 and np.isfinite(values).any():
        return f"{' to '.join(numbers(shown, [np.nanmin(values), np.nanmax(values)], 3))} {shown.unit}"
    return f"{', '.join(numbers(shown, values, 3))} {shown.unit}"
