"""Settings: cases, windows and limits."""

from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


@dataclass(frozen=True)
class Case:
    """A case of input/, with overrides."""

    name: str
    case: str
    overrides: tuple[str, ...] = ()

    def changed(self, *overrides: str) -> "Case":
        return Case(self.name, self.case, (*self.overrides, *overrides))

    @property
    def is_runup(self) -> bool:
        return self.name in RUNUPS.values()


#: Pad that is shown and measured, the paper's first; revolutions that numbers are taken over.
PAD, LAST = 1, 5
#: Revolutions shown of the run-up in detail.
DETAIL = 3

#: Every case of input/paper, by its file's name.
PAPER = tuple(Case(path.stem, str(path.relative_to(ROOT))) for path in sorted(ROOT.glob("input/paper/*.nml")))

BA, LUGRE, FRICTIONLESS, BA_10_10 = (
    f"input/paper/{name}.nml" for name in ("steady_ba_10_05", "steady_lugre", "steady_tr", "steady_tr_ba")
)

#: Friction pairs f_s/f_d of Figs. 11 to 13, and the runs of a pair: Bengisu-Akay, LuGre 1e6, LuGre 5e6.
PAIRS = ("0.1/0.05", "0.1/0.1", "0.2/0.1", "0.2/0.2")
MODELS = {
    "Bengisu-Akay": ("steady_ba_10_05", "steady_tr_ba", "steady_ba_20_10", "steady_ba_20_20"),
    "LuGre 1e6": ("steady_lugre", "steady_lugre_10_10", "steady_lugre_20_10", "steady_lugre_20_20"),
    "LuGre 5e6": ("steady_lugre5", "steady_lugre5_10_10", "steady_lugre5_20_10", "steady_lugre5_20_20"),
}

#: Critical velocities of Fig. 7, m/s, and bristle stiffnesses of Fig. 8, 1/m, with their runs.
VELOCITIES = {"1e-3": "steady_ba_vc3", "1e-4": "ba_vc4", "1e-5": "steady_ba_10_05"}
STIFFNESSES = {
    "1e5": "steady_lugre01",
    "1e6": "steady_lugre",
    "5e6": "steady_lugre5",
    "2e7": "lugre20",
    "1e8": "lugre100",
}
FIGURES_7_8 = (
    Case("ba_vc4", BA, ("friction%critical_velocity=1e-4",)),
    Case("lugre20", LUGRE, ("friction%bristle_stiffness=2e7",)),
    Case("lugre100", LUGRE, ("friction%bristle_stiffness=1e8",)),
)

#: Radius differences of Fig. 10, um, with their runs without and with friction; tilting-only stands beside.
DIFFERENCES = {
    "0": ("steady_dr0", "steady_dr0_ba"),
    "15": ("steady_tr", "steady_tr_ba"),
    "30": ("steady_dr30", "steady_dr30_ba"),
}
TILTING_ONLY = ("steady_to", "steady_to_ba")

#: Run-ups of Fig. 15, by the words of the legend.
RUNUPS = {"Bengisu-Akay": "runup_ba", "LuGre 1e6": "runup_lugre", "LuGre 5e6": "runup_lugre5"}
#: Speeds of the run-up, rpm, whose revolutions are looked at closely: low, and the last ones.
LOW_SPEED, HIGH_SPEED = 2000, 6500

#: The quality grade of section 3, with which rule (26) gives the unbalance of each speed.
GRADE = 6.3
#: The lowest speed of the paper, rpm.
LOWEST = 1500


def at_speed(speed: float, grade: float = GRADE) -> tuple[str, ...]:
    """Overrides: a steady speed with the unbalance that rule (26) gives for it."""
    return f"operation%speed_rpm={speed:g}", f"rotor%balance_grade={grade:g}"


#: The balance grade of a well balanced rotor, whose pads stay stuck at full speed.
FINE_GRADE = 1
SLOW = tuple(
    Case(f"{model}_{words}", case, overrides)
    for model, case in (("ba", BA), ("lugre", LUGRE))
    for words, overrides in (("slow", at_speed(LOWEST)), ("fine", at_speed(6500, FINE_GRADE)))
)

#: The upper pads: four against two, with Guembel's condition.
UPPER_PADS = (
    Case("two_pads", LUGRE, ("film%cavitation=gumbel",)),
    Case("four_pads", "input/examples/four_pads.nml"),
    Case("two_pads_none", FRICTIONLESS, ("film%cavitation=gumbel",)),
    Case("four_pads_none", "input/examples/four_pads.nml", ("friction%model=none",)),
)

#: What a comparison must exceed to count, ten times the error that the default settings are held to.
RESOLUTION = 0.01
#: Journal paths closer than this part of the orbit's size agree.
AGREEMENT = 0.1
#: A pad sticks if it is slow for this multiple of the time that a sinusoid of its amplitude would be.
STICKS = 2.0
#: Part of f_s within which friction coefficients lie on one curve.
ON_CURVE = 0.01
#: The same runs again, to tell numerics from physics: finer film, tighter tolerance, and a shorter march.
REFINED = ("film%circumferential_cells=32", "film%axial_modes=8", "integration%relative_tolerance=1e-6")
#: Rule (26) with the grade of section 3 instead of the unbalance of Table 1.
RULE = f"rotor%balance_grade={GRADE:g}"
#: Long enough to be periodic; it ends at the same shaft angle as 2 s at 6500 rpm.
SHORT = "operation%duration=0.8"
#: Seconds at the end of a run that are written: more than the last revolutions at the lowest speed.
KEPT = 0.25


def refined(case: Case) -> Case:
    """The case with the settings REFINED."""
    return shorter(case.changed(*REFINED))


def balanced(case: Case) -> Case:
    """The case with the unbalance of rule (26)."""
    own = any("balance_grade" in word for word in case.overrides)
    return shorter(case if own else case.changed(RULE))


def shorter(case: Case) -> Case:
    """The case with the duration SHORT, unless it is a run-up; of which the end is kept."""
    return case if case.is_runup else case.changed(SHORT, f"output%start_time={0.8 - KEPT:g}")


def kept(case: Case) -> Case:
    """The case, of which the end is kept unless it is a run-up."""
    return case if case.is_runup else case.changed(f"output%start_time={2 - KEPT:g}")


def coefficients(static: float, dynamic: float) -> tuple[str, ...]:
    return f"friction%static_coefficient={static:g}", f"friction%dynamic_coefficient={dynamic:g}"


#: The runs of the figures and claims.
CASES = (*PAPER, *FIGURES_7_8, *SLOW, *UPPER_PADS)
