"""Machines in ROSS and in the program on the same bearings: for tests and docs/verify_machines.py."""

import gzip
import json
import subprocess
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import h5py
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
#: The file that is there when ROSS is installed.
READY = ROOT / "build/venv-ross/ready"
#: What ROSS answered when `make ross` last asked it, with its version; how close a question must be to one of
#: these, as a share of the largest number of an array.
RECORD, SAME = ROOT / "tests/post/ross_answers.json.gz", 1e-7
#: Place of the pivots that are locked, whose bearings couple y and z as strongly as they resist.
LOCKED = 1
#: All modes of the shaft, without damping: the equations of ROSS.
CASE = """
&case task = 'coefficients' /
&operation speed_rpm = {speed} /
{rotor}
&unbalance station = {unbalance}, moment = 0.02, angle_deg = 0 /
&reduction frequency = 1e7, damping_ratio = 0 /
&bearing name = 'left', station = 2 /
&bearing name = 'right', station = 12, assembled_clearance = 90e-6 /
&film cavitation = 'none' /
"""
LENGTH, DIAMETER = [0.05, 0.05, *[0.2] * 8, 0.05, 0.05], [*[0.0998] * 2, *[0.34] * 8, *[0.0998] * 2]
#: Station, mass, diametral and polar moment of inertia of discs; station of the unbalance.
DISC = (2847.3706547456786, 280.5609218476075, 512.526717854222)
ROTORS = {
    "disc in the middle": ([(7, *DISC)], 7),
    "off the middle and overhung": ([(5, *DISC), (13, 300.0, 12.0, 20.0)], 13),
}


@contextmanager
def questions() -> Iterator:
    """answer(bearing=..., points=...): what ROSS answers to ross_program.py; answer.close: how well."""
    words = [READY.parent / "bin/python", ROOT / "tests/post/ross_program.py"]
    with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:

        def answer(**asked) -> dict[str, np.ndarray]:
            print(json.dumps({"points": [], "speeds": []} | asked), file=process.stdin, flush=True)
            # libraries of ROSS may print lines of their own
            said = next((line for line in process.stdout if line.startswith("{")), None)
            assert said, "ROSS ended without an answer"
            return {name: np.array(values) for name, values in json.loads(said).items()}

        answer.close = 0.0
        yield answer


@contextmanager
def recording() -> Iterator:
    """As questions(), and writes questions and answers into the record."""
    told = []
    with questions() as ask:

        def answer(**asked) -> dict[str, np.ndarray]:
            found = ask(**asked)
            told.append([completed(asked), {name: values.tolist() for name, values in found.items()}])
            return found

        answer.close = ask.close
        version = str(ask(version=True)["version"])
        yield answer
    content = json.dumps({"version": version, "answers": told}, separators=(",", ":"))
    RECORD.write_bytes(gzip.compress(content.encode(), mtime=0))


@contextmanager
def recorded() -> Iterator:
    """As questions(), from the record. A question that is not there ends the test."""
    told = json.loads(gzip.decompress(RECORD.read_bytes()))["answers"]

    def answer(**asked) -> dict[str, np.ndarray]:
        wanted = completed(asked)
        found = next((found for question, found in told if same(question, wanted)), None)
        assert found, f"ROSS was never asked this, or another bearing: make ross asks it ({RECORD.name})"
        return {name: np.array(values) for name, values in found.items()}

    answer.close = SAME
    yield answer


def completed(asked):
    """A question as JSON has it, with what is in files in place of their names."""
    if isinstance(asked, dict):
        return {name: completed(each) for name, each in asked.items()}
    if isinstance(asked, str) and asked.endswith(".toml"):
        return tomllib.loads(Path(asked).read_text())
    return json.loads(json.dumps(asked))


def same(one, other):
    """Whether a question is another but for the rounding of its numbers."""
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(same(one[name], other[name]) for name in one)
    if isinstance(one, (dict, str)) or isinstance(other, (dict, str)):
        return one == other
    a, b = np.array(one, dtype=float), np.array(other, dtype=float)
    return a.shape == b.shape and np.allclose(a, b, rtol=0, atol=SAME * np.abs(a).max(initial=0))


def in_ross(matrix):
    """A matrix of y, z in the axes x = -z, y: turned, not by the formula of tiltpad.to_ross."""
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    return turn @ matrix @ turn.T


def shaft(discs):
    """The rotor's groups."""
    lines = [f"&shaft length = {row(LENGTH)}, diameter = {row(DIAMETER)} /"]
    names = ("station", "mass", "diametral_inertia", "polar_inertia")
    for each in discs:
        lines.append(f"&disc {', '.join(f'{k} = {v!r}' for k, v in zip(names, each, strict=True))} /")
    return "\n".join(lines)


def row(values):
    return ", ".join(map(repr, values))


def linear(program, folder, rotor, unbalance, speed):
    """Eigenvalues and whirl, (station, y and z), on the bearings' synchronous matrices, and these."""
    path = Path(folder) / "machine.nml"
    path.write_text(CASE.format(speed=speed, rotor=rotor, unbalance=unbalance))
    output = path.with_suffix(".h5")
    words = [program, "--quiet", "--overwrite", path, "--output", output]
    subprocess.run(words, cwd=folder, check=True)
    with h5py.File(output) as file:
        values = (
            file["synchronous/eigenvalue_real"][LOCKED] + 1j * file["synchronous/eigenvalue_imag"][LOCKED]
        )
        moved = [
            file[f"response/{name}_real"][LOCKED] + 1j * file[f"response/{name}_imag"][LOCKED]
            for name in "yz"
        ]
        matrices = {
            name: [file[f"bearings/{b}/coefficients/{name}"][LOCKED, 0] for b in ("left", "right")]
            for name in ("stiffness", "damping")
        }
    return values[np.isfinite(values)], np.transpose(moved), matrices


def by_ross(ross, discs, unbalance, speed, matrices, seal="", described=False):
    """ROSS's rotor on the same matrices, and `described` its own.

    Its nodes count from 0; +y is a quarter turn ahead of its x.
    """
    return ross(
        machine={
            "length": LENGTH,
            "diameter": DIAMETER,
            "discs": [(station - 1, *rest) for station, *rest in discs],
            "nodes": [1, 11],
            "speed": speed * np.pi / 30,
            "unbalance": [unbalance - 1, 0.02, np.pi / 2],
            "seal": str(seal),
            "described": described,
            **{name: [in_ross(each).tolist() for each in values] for name, values in matrices.items()},
        }
    )


def whirl_of(found):
    """ROSS's whirl of each station along y and z."""
    x, y = np.moveaxis(found["moved"] @ [1, 1j], -1, 0)
    return np.transpose([y, -x])


def vibrating(values, highest):
    """The eigenvalues of vibrations, without their conjugates, that are smaller than the highest, rad/s."""
    return values[(values.imag > 1e-6 * abs(values)) & (abs(values) < highest)]


def farthest(values, others):
    """The largest relative distance of a value from the nearest of the others."""
    return max(abs(others - each).min() / abs(each) for each in values)
