"""The equations of docs/theory as a Python user would write them, with NumPy and Numba: film by projected
over-relaxation, pads tilting-radial, LuGre friction; no boundary pressures, constant speed.
"""

import math

import numba
import numpy as np
from scipy.interpolate import PchipInterpolator

#: Columns along the arc, rows across half the width.
COLUMNS, ROWS = 60, 15
MOST_SWEEPS = 20000
STATES = 5


def optimal_relaxation(arc: float, radius: float, length: float) -> float:
    """Young's factor for a uniform film on the grid."""
    along, across = (COLUMNS / arc) ** 2, (2 * ROWS * radius / length) ** 2
    gap = along * (1 - math.cos(math.pi / COLUMNS)) + across * (1 - math.cos(math.pi / (2 * ROWS)))
    gap /= along + across
    return 2 / (1 + math.sqrt(gap * (2 - gap)))


def compliance(pivot: dict) -> float:
    """k1 + k2 of (18), 1/Pa."""
    poisson, young = np.array(pivot["poisson_ratio"]), np.array(pivot["young_modulus"])
    return float(np.sum((1 - poisson**2) / (np.pi * young)))


def contact_table(pivot: dict, cells: int = 4000) -> tuple[float, np.ndarray]:
    """Fang's law (11)-(18): spacing of the pivot deflections, and the force at each; forces up to some 100
    kN."""
    outer = float(np.max(pivot["socket_radius"]))
    difference = float(np.max(pivot["radius_difference"]))
    inner = outer - difference
    k = compliance(pivot)
    a = outer * np.geomspace(1e-4, 1, 20001)
    n = 0.5 - 0.24 * np.exp(-15.08 * (1 - a / outer))
    gamma = np.vectorize(math.gamma)
    b = np.sqrt(np.pi) / 2 * gamma(n + 1) / gamma(n + 1.5)
    g = 2 / np.pi + (a / outer) ** 2
    room = 4 * b * inner * outer * k * (n + 0.5) * (n + 1) - a**3 * np.pi * 3.8304 * b * k / (np.pi * outer)
    grows = room > 0.01 * room.max()
    grows &= np.cumprod(grows).astype(bool) | (a < 0.3 * outer)
    force = a**3 * np.pi * g * difference / np.where(grows, room, 1.0)
    pivot_deflection = pivot["deflection_factor"] * k * b * (n + 1) * force / (np.pi * a)
    a, force, pivot_deflection = a[grows], force[grows], pivot_deflection[grows]
    most = min(pivot_deflection[-1], 4e-5)
    law = PchipInterpolator(np.append(0, pivot_deflection), np.append(0, force))
    return most / cells, law(np.linspace(0, most, cells + 1))


@numba.njit(cache=True, fastmath={"contract", "reassoc", "arcp", "nsz"})
def film(ey, ez, vy, vz, speed, geometry, tolerance, p):
    """Film force on the journal in the pad frame; `p` is the last field and becomes this one. It is solved
    when a sweep changes no pressure by more than `tolerance` times the highest."""
    radius, journal_radius, machined, length, leading, trailing, viscosity, relaxation = geometry
    n, m = COLUMNS, ROWS
    d_phi, d_z = (leading + trailing) / n, length / (2 * m)
    along, beside, source = np.empty(n + 1), np.empty(n), np.empty(n)
    before = 0.0
    for i in range(n + 1):
        phi = i * d_phi - trailing
        h = machined - ey * math.sin(phi) - ez * math.cos(phi)
        if h <= 0:
            return math.nan, math.nan
        along[i] = h**3 / d_phi**2 * (2 if i in (0, n) else 1)
        if i > 0:
            middle = phi - 0.5 * d_phi
            s, c = math.sin(middle), math.cos(middle)
            beside[i - 1] = (machined - ey * s - ez * c) ** 3 * (radius / d_z) ** 2
            source[i - 1] = -6 * viscosity * speed * journal_radius * radius * (h - before) / d_phi
            source[i - 1] -= 12 * viscosity * radius**2 * (vy * s + vz * c)
        before = h
    edge = 2 / (1 - 1 / (3 * m))
    for _ in range(MOST_SWEEPS):
        most = change = 0.0
        for i in range(n):
            for j in range(m):
                inner = beside[i] if j > 0 else 0.0
                outer = beside[i] * (edge if j == m - 1 else 1.0)
                total = inner * p[i + 1, j] + (outer * p[i + 1, j + 2] if j < m - 1 else 0.0) - source[i]
                total += along[i] * p[i, j + 1] + along[i + 1] * p[i + 2, j + 1]
                old = p[i + 1, j + 1]
                new = old + relaxation * (total / (along[i] + along[i + 1] + inner + outer) - old)
                new = max(new, 0.0)
                p[i + 1, j + 1] = new
                change, most = max(change, abs(new - old)), max(most, new)
        if change <= tolerance * most:
            break
    fy = fz = 0.0
    for i in range(n):
        phi = (i + 0.5) * d_phi - trailing
        total = -2 * radius * d_phi * d_z * p[i + 1, 1 : m + 1].sum()
        fy += total * math.sin(phi)
        fz += total * math.cos(phi)
    return fy, fz


@numba.njit(cache=True)
def pad_rates(
    journal, states, speed, gravity, pads, geometry, contact, friction, tolerance, fields, moments, dydt
):
    """Force of the films on a journal (y, z and their rates); fills the rates of the pads' states, eqs (3),
    (4) and (24), and the friction moments."""
    spacing, forces = contact
    ball, static, dynamic, stribeck, stiffness, damping = friction
    fy = fz = 0.0
    for k in range(len(pads)):
        theta, pivot_radius, centre, pad_mass, inertia, centre_radial = pads[k]
        tilt, tilt_rate, depth, depth_rate, bristle = states[STATES * k : STATES * (k + 1)]
        s, c = math.sin(theta - tilt), math.cos(theta - tilt)
        ry = journal[0] - (pivot_radius + depth) * math.sin(theta)
        rz = journal[1] - (pivot_radius + depth) * math.cos(theta)
        wy, wz = journal[2] - depth_rate * math.sin(theta), journal[3] - depth_rate * math.cos(theta)
        along, outward = ry * c - rz * s, ry * s + rz * c
        vy, vz = wy * c - wz * s + tilt_rate * outward, wy * s + wz * c - tilt_rate * along
        film_y, film_z = film(along, outward + centre, vy, vz, speed, geometry[k], tolerance, fields[k])
        fy += c * film_y + s * film_z
        fz += -s * film_y + c * film_z
        cell = depth / spacing
        at = min(int(cell), len(forces) - 2)
        normal = forces[at] + (cell - at) * (forces[at + 1] - forces[at]) if depth > 0 else 0.0
        velocity = ball * tilt_rate
        steady = dynamic + (static - dynamic) * math.exp(-abs(velocity) / stribeck)
        bristle_rate = velocity - stiffness * abs(velocity) / steady * bristle
        moments[k] = ball * normal * (stiffness * bristle + damping * bristle_rate)
        moment = -film_y * centre - moments[k] + pad_mass * gravity * centre_radial * c
        radial = -film_z - normal - pad_mass * gravity * s + pad_mass * centre_radial * tilt_rate**2
        dydt[STATES * k] = tilt_rate
        dydt[STATES * k + 1] = moment / inertia
        dydt[STATES * k + 2] = depth_rate
        dydt[STATES * k + 3] = radial / pad_mass
        dydt[STATES * k + 4] = bristle_rate
    return fy, fz


@numba.njit(cache=True)
def rates(t, y, speed, rotor, pads, geometry, contact, friction, tolerance, fields, moments):
    """Right-hand side (1)-(4) and (24); fills the friction moments."""
    mass, unbalance, gravity = rotor
    dydt = np.empty_like(y)
    fy, fz = pad_rates(
        y[:4], y[4:], speed, gravity, pads, geometry, contact, friction, tolerance, fields, moments, dydt[4:]
    )
    fy += unbalance * speed**2 * math.cos(speed * t) - mass * gravity
    fz += unbalance * speed**2 * math.sin(speed * t)
    dydt[0], dydt[1], dydt[2], dydt[3] = y[2], y[3], fy / mass, fz / mass
    return dydt


class Bearing:
    """A case of the archive, ready for an integrator: bearing(t, y) is its right-hand side."""

    def __init__(self, case: dict[str, dict], film_tolerance: float):
        bearing, pads, rotor, law = (case[name] for name in ("bearing", "pads", "rotor", "friction"))
        self.count = len(np.atleast_1d(pads["pivot_angle_deg"]))
        self.film_tolerance = film_tolerance
        machined, inner, length = (
            self.each(bearing[name]) for name in ("machined_clearance", "journal_radius", "axial_length")
        )
        radius = inner + machined
        arc, distance = np.radians(self.each(pads["arc_deg"])), self.each(pads["pivot_distance"])
        ratio = self.each(pads["pivot_ratio"])
        self.pads = self.columns(
            np.radians(pads["pivot_angle_deg"]), inner + self.each(bearing["assembled_clearance"]) + distance,
            radius + distance, pads["mass"], pads["inertia"], pads["centre_radial"],
        )  # fmt: skip
        relaxation = [optimal_relaxation(*each) for each in zip(arc, radius, length, strict=True)]
        self.geometry = self.columns(
            radius, inner, machined, length, ratio * arc, (1 - ratio) * arc, bearing["viscosity"], relaxation
        )
        self.speed = case["operation"]["speed_rpm"] * np.pi / 30
        self.rotor = float(rotor["mass"]), float(rotor["unbalance"]), float(rotor["gravity"])
        self.contact = contact_table(case["pivot"])
        ball = float(np.max(case["pivot"]["socket_radius"]) - np.max(case["pivot"]["radius_difference"]))
        stiffness = float(law["bristle_stiffness"])
        coefficients = (float(np.max(law[f"{name}_coefficient"])) for name in ("static", "dynamic"))
        damping = float(np.sqrt(stiffness / law["characteristic_load"]))
        self.friction = ball, *coefficients, law["stribeck_velocity"], stiffness, damping
        self.fields = np.zeros((self.count, COLUMNS + 2, ROWS + 2))
        self.moments = np.zeros(self.count)

    def each(self, value) -> np.ndarray:
        """A value for every pad."""
        return np.broadcast_to(np.asarray(value, float), self.count)

    def columns(self, *values) -> np.ndarray:
        """(pad, value)."""
        return np.column_stack([self.each(value) for value in values])

    def scales(self, clearance: float, depth: float) -> np.ndarray:
        """Characteristic scale of each state, as tiltpad has it (docs/theory)."""
        tilt = clearance / (self.geometry[0, 0] * (self.geometry[0, 4] + self.geometry[0, 5]))
        bristle = self.friction[1] / self.friction[4]
        pad = [tilt, tilt * self.speed, depth, depth * self.speed, bristle]
        return np.array([clearance] * 2 + [clearance * self.speed] * 2 + pad * self.count)

    def __call__(self, t: float, y: np.ndarray) -> np.ndarray:
        return rates(
            t, y, self.speed, self.rotor, self.pads, self.geometry, self.contact, self.friction,
            self.film_tolerance, self.fields, self.moments,
        )  # fmt: skip

    def force(self, journal: np.ndarray, states: np.ndarray, dydt: np.ndarray) -> tuple[float, float]:
        """Force on a journal (y, z and their rates); fills the rates of the pads' states."""
        return pad_rates(
            journal, states, self.speed, self.rotor[2], self.pads, self.geometry, self.contact, self.friction,
            self.film_tolerance, self.fields, self.moments, dydt,
        )  # fmt: skip
