"""Tables of docs/verification.md about machines: elastic rotors in several bearings."""

import re
import sys
from pathlib import Path

import h5py
import numpy as np
from verify_film import lines
from verify_runs import result_of, row

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests/post"))
import ross_machine  # noqa: E402

#: How many times as many random rotors as in a test.
TIMES = 12
#: A rotor of 4 t with a disc in the middle in two of the paper's bearings.
CASE = """
&operation speed_rpm = 4100 /
&shaft length = 0.05, 0.05, 8*0.2, 0.05, 0.05, diameter = 2*0.0998, 8*0.34, 2*0.0998 /
&disc station = 7, mass = 2847.3706547456786, polar_inertia = 512.526717854222,
   diametral_inertia = 280.5609218476075 /
&unbalance station = 7, moment = 0.02 /
&bearing name = 'left', station = 2 /
&bearing name = 'right', station = 12 /
&film cavitation = 'none' /
"""
#: Values of an independent program: frequencies of the shaft with its journals held, Hz; y of a journal and
#: of the disc in equilibrium, um; stiffness and damping of a bearing; eigenvalues, 1/s, with free pivots,
#: with the synchronous matrices in place of the pads, and with stuck pivots.
HELD = (91.8029, 263.5415, 947.0458)
REST = {"journal": (2, -67.1872), "disc": (7, -98.0403)}
COEFFICIENTS = {"stiffness": (582.5918, "MN/m"), "damping": (0.941046, "MN s/m")}
FREE = (-69.529 + 407.877j, -70.074 + 408.457j, -323.722 + 388.358j, -379.598 + 379.975j)
SYNCHRONOUS, STUCK = -67.842 + 413.382j, -42.474 + 428.004j
#: Its amplitudes of the disc's y at the frequency of the shaft, um: linear, without friction, with LuGre.
WHIRL = {
    3300: (8.66265, 8.72335, 8.64448),
    4100: (18.76877, 18.35041, 21.13042),
    5200: (11.89040, 11.75074, 13.46417),
}
#: Examples of Friswell, Penny, Garvey and Lees (2010) at 4000 rpm, rad/s.
TEXTBOOK = {
    "5.9.1": (85.39, 87.80, 251.78, 294.71, 600.18, 827.08),
    "5.9.2": (82.33, 86.86, 239.64, 287.25, 583.49, 806.89),
    "5.9.9": (76.19, 103.91, 565.99, 634.23, 647.75, 1174.2),
}
#: Speeds of the Campbell diagram, rpm, and the frequency up to which it has modes, Hz.
SPEEDS, HIGHEST = range(1000, 10001, 1000), 1000
PRINTED = re.compile(r"example (?P<name>\S+): *(?P<values>.*)")
SHARES = re.compile(
    r"(?P<what>[^:]+): (?P<rotors>\d+) rotors;[^\d]+(?P<errors>.+); over the estimate(?P<ratios>.+)"
)


def opened(program, folder, *overrides):
    """The result file of the rotor with these changes."""
    path = Path(folder) / "machine.nml"
    path.write_text(CASE)
    return h5py.File(result_of(program, path, folder, *overrides))


def compared(label, value, reference, digits=6):
    """A number beside that of the independent program."""
    error = abs(value - reference) / abs(reference)
    shown = f"{value:.{digits}g}" if np.isreal(value) else f"{value:.3f}".replace("j", " i")
    return row(label, shown, str(reference).strip("()").replace("j", " i"), f"{error:.1e}")


def machine(program, folder):
    """Rows of values against the independent program."""
    lugre, six_modes = "friction%model=lugre", "reduction%frequency=6000"
    with opened(program, folder, "case%task=coefficients", lugre, six_modes) as file:
        for k, reference in enumerate(HELD):
            frequency = file["rotor/mode_frequency"][k]
            yield compared(f"journals held, frequency {k + 1}, Hz", frequency, reference, 7)
        for name, (station, reference) in REST.items():
            yield compared(
                f"y of the {name} in equilibrium, um",
                1e6 * file["equilibrium/station_y"][station - 1],
                reference,
            )
        for name, (reference, unit) in COEFFICIENTS.items():
            value = 1e-6 * file[f"bearings/left/coefficients/{name}"][0, 0, 0, 0]
            yield compared(f"synchronous {name} (yy), {unit}", value, reference)
        modes = [file[f"modes/eigenvalue_{part}"][()] for part in ("real", "imag")]
        given = [file[f"synchronous/eigenvalue_{part}"][()] for part in ("real", "imag")]
        pivots = [file["pivot"].asstr()[k] for k in range(len(file["pivot"]))]
    modes, given = (real + 1j * imag for real, imag in (modes, given))
    for k, reference in enumerate(FREE):
        yield compared(f"eigenvalue {k + 1}, free pivots, 1/s", nearest(modes[0], reference), reference)
    words = "eigenvalue 1, synchronous stiffness and damping for the pads, 1/s"
    yield compared(words, nearest(given[0], SYNCHRONOUS), SYNCHRONOUS)
    stuck = modes[pivots.index("stuck")]
    yield compared("eigenvalue 1, stuck pivots, 1/s", nearest(stuck, STUCK), STUCK)


def nearest(values, value):
    """The one of the values that is closest."""
    values = values[np.isfinite(values)]
    return complex(values[abs(values - value).argmin()])


def whirl(program, folder):
    """Rows of the whirl of the disc at three speeds."""
    for speed, references in WHIRL.items():
        at_speed = f"operation%speed_rpm={speed}"
        with opened(program, folder, "case%task=coefficients", at_speed) as file:
            values = [1e6 * abs(file["response/y_real"][0, 6] + 1j * file["response/y_imag"][0, 6])]
        for friction in ("none", "lugre"):
            settings = ("case%task=periodic", at_speed, f"friction%model={friction}")
            with opened(program, folder, *settings) as file:
                angle, y = file["shaft_angle"][:-1], file["station_y"][:-1, 6]
            values.append(2e6 * abs(np.mean(y * np.exp(-1j * angle))))
        cells = [
            f"{value:.5f} / {reference} ({abs(value / reference - 1):.1e})"
            for value, reference in zip(values, references, strict=True)
        ]
        yield row(speed, *cells)


def textbook(program, _folder):
    """Rows of the textbook's rotors: what the test prints, and the book."""
    found = {each["name"]: each["values"].split() for each in map(PRINTED.match, printed(program)) if each}
    for name, references in TEXTBOOK.items():
        values = [float(each) for each in found[name]]
        yield row(name, *(f"{a:g} / {b:g}" for a, b in zip(values, references, strict=True)))


def printed(program):
    """What the test of rotors says."""
    return lines(program, "test_rotor_matrices")


def random_rotors(program, _folder):
    """Rows of the errors of the reduction for random rotors."""
    for found in filter(None, map(SHARES.match, lines(program, "test_mode_selection", TIMES))):
        errors = [f"{float(each):.1e}" for each in found["errors"].split()]
        ratios = [f"{float(each):.1f}" for each in found["ratios"].split()]
        yield row(found["what"], found["rotors"], *errors, *ratios)


def campbell_by_ross(program, folder):
    """Rows of the modes and of the whirl of rotors over the speed, against ROSS."""
    if not ross_machine.READY.exists():
        sys.exit("verify.py: ROSS is not installed")
    with ross_machine.questions() as ross:
        for name, (discs, unbalance) in ross_machine.ROTORS.items():
            for speed in SPEEDS:
                groups = ross_machine.shaft(discs)
                values, moved, matrices = ross_machine.linear(program, folder, groups, unbalance, speed)
                found = ross_machine.by_ross(ross, discs, unbalance, speed, matrices)
                yield row(name, speed, *beside_ross(values, moved, found))


def beside_ross(values, moved, found):
    """How many modes both have, the frequency of the highest, Hz, and the largest differences."""
    theirs = found["eigenvalues"] @ [1, 1j]
    both = [ross_machine.vibrating(each, 2 * np.pi * HIGHEST) for each in (values, theirs)]
    modes = max(ross_machine.farthest(both[0], theirs), ross_machine.farthest(both[1], values))
    stations = abs(ross_machine.whirl_of(found) - moved).max() / abs(moved).max()
    counts, top = (len(each) for each in both), abs(both[0]).max() / (2 * np.pi)
    return (*counts, f"{top:.1f}", f"{modes:.0e}", f"{stations:.0e}")


TABLES = (machine, whirl, campbell_by_ross, textbook, random_rotors)
