"""Settings: scenes, windows and limits."""

from dataclasses import dataclass
from itertools import product
from math import pi
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


@dataclass(frozen=True)
class Scene:
    """A case of input/, with overrides."""

    name: str
    case: str
    overrides: tuple[str, ...] = ()


#: Pad that is shown and measured, the paper's first; revolutions that numbers are taken over.
PAD, LAST = 1, 5
#: Revolutions shown of the run-up in detail.
DETAIL = 3

#: Every case of input/paper, by its file's name.
PAPER = tuple(
    Scene(path.stem, str(path.relative_to(ROOT))) for path in sorted(ROOT.glob("input/paper/*.nml"))
)

BA, LUGRE, FRICTIONLESS = (
    f"input/paper/{name}.nml" for name in ("steady_ba_10_05", "steady_lugre", "steady_tr")
)
#: Bengisu-Akay f = 0.1, the friction of Figs. 9 and 10.
BA_10_10 = "input/paper/steady_tr_ba.nml"

#: Friction pairs f_s/f_d of Figs. 11 to 13, and the runs of a pair: Bengisu-Akay, LuGre 1e6, LuGre 5e6.
PAIRS = ("0.1/0.05", "0.1/0.1", "0.2/0.1", "0.2/0.2")
MODELS = {
    "Bengisu-Akay": ("steady_ba_10_05", "steady_tr_ba", "steady_ba_20_10", "steady_ba_20_20"),
    "LuGre 1e6": ("steady_lugre", "steady_lugre_10_10", "steady_lugre_20_10", "steady_lugre_20_20"),
    "LuGre 5e6": ("steady_lugre5", "steady_lugre5_10_10", "steady_lugre5_20_10", "steady_lugre5_20_20"),
}

#: The example of Figs. 3 and 4: socket radius, m, load of Fig. 3, N, radius differences, um, and penetrations
#: up to, m, of Fig. 4. The paper prints the first of them only.
FANG_PIVOT, FANG_LOAD, FANG_DIFFERENCES, FANG_PENETRATION = 0.1, 1e4, (0, 15, 30, 60), 20e-6

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
    Scene("ba_vc4", BA, ("friction%critical_velocity=1e-4",)),
    Scene("lugre20", LUGRE, ("friction%bristle_stiffness=2e7",)),
    Scene("lugre100", LUGRE, ("friction%bristle_stiffness=1e8",)),
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
    Scene(f"{model}_{words}", case, overrides)
    for model, case in (("ba", BA), ("lugre", LUGRE))
    for words, overrides in (("slow", at_speed(LOWEST)), ("fine", at_speed(6500, FINE_GRADE)))
)

#: The upper pads: four against two, with Guembel's condition.
UPPER_PADS = (
    Scene("two_pads", LUGRE, ("film%cavitation=gumbel",)),
    Scene("four_pads", "input/examples/four_pads.nml"),
    Scene("two_pads_none", FRICTIONLESS, ("film%cavitation=gumbel",)),
    Scene("four_pads_none", "input/examples/four_pads.nml", ("friction%model=none",)),
)

#: What a comparison must exceed to count, ten times the error that the default settings are held to.
RESOLUTION = 0.01
#: Journal paths closer than this part of the orbit's size agree.
AGREEMENT = 0.1
#: A pad that is slow so many times as long as a sinusoid of its amplitude comes to rest.
RESTS = 2.0
#: Part of f_s within which friction coefficients lie on one curve.
ON_CURVE = 0.01
#: The same runs again, to tell numerics from physics: finer film, tighter tolerance, and a shorter march.
REFINED = (
    "film%circumferential_cells=32",
    "film%axial_modes=8",
    "integration%relative_tolerance=1e-6",
)
#: Rule (26) with the grade of section 3 instead of the unbalance of Table 1.
RULE = f"rotor%balance_grade={GRADE:g}"
#: Long enough to be periodic; it ends at the same shaft angle as 2 s at 6500 rpm.
SHORT = "operation%duration=0.8"
#: Seconds at the end of a run that are written: more than the last revolutions at the lowest speed.
KEPT = 0.25


def refined(scene: Scene) -> Scene:
    """The scene with the settings REFINED."""
    return shorter(Scene(scene.name, scene.case, (*scene.overrides, *REFINED)))


def balanced(scene: Scene) -> Scene:
    """The scene with the unbalance of rule (26)."""
    own = any("balance_grade" in word for word in scene.overrides)
    return shorter(Scene(scene.name, scene.case, scene.overrides if own else (*scene.overrides, RULE)))


def shorter(scene: Scene) -> Scene:
    """The scene with the duration SHORT, unless it is a run-up; of which the end is kept."""
    return changed_unless_runup(scene, SHORT, f"output%start_time={0.8 - KEPT:g}")


def kept(scene: Scene) -> Scene:
    """The scene, of which the end is kept unless it is a run-up."""
    return changed_unless_runup(scene, f"output%start_time={2 - KEPT:g}")


def changed_unless_runup(scene: Scene, *overrides: str) -> Scene:
    if scene.name in RUNUPS.values():
        return scene
    return Scene(scene.name, scene.case, (*scene.overrides, *overrides))


# ---- beyond the paper ------------------------------------------------------------------------------------
#: Map of the stick fraction: speeds, rpm, and static friction coefficients, the dynamic ones half as large.
MAP_SPEEDS = tuple(range(1500, 6501, 500))
MAP_COEFFICIENTS = (0.01, 0.02, 0.035, 0.05, 0.075, 0.1, 0.15, 0.2)
#: Only the last revolutions are kept.
MAP_TIME = ("operation%duration=0.5", "output%start_time=0.25")


def coefficients(static: float, dynamic: float) -> tuple[str, ...]:
    return f"friction%static_coefficient={static:g}", f"friction%dynamic_coefficient={dynamic:g}"


def map_name(speed: float, coefficient: float) -> str:
    return f"map_{speed:g}_{coefficient:g}"


MAP = tuple(
    Scene(map_name(speed, f), BA, (*coefficients(f, f / 2), *at_speed(speed), *MAP_TIME))
    for speed in MAP_SPEEDS
    for f in MAP_COEFFICIENTS
)

#: Contact laws beside the paper's, by their overrides.
LAWS = {
    "Fang, factor 4": (),
    r"Fang, factor 2 pi": (f"pivot%penetration_factor={2 * pi:.15g}",),
    "Hertz": ("pivot%law=hertz",),
}
LAW_DIFFERENCES = (15, 30)


def law_name(law: str, difference: int, friction: bool) -> str:
    return f"law_{list(LAWS).index(law)}_{difference}_{'ba' if friction else 'none'}"


LAW_SCENES = tuple(
    shorter(Scene(law_name(law, difference, friction), BA_10_10 if friction else FRICTIONLESS,
                  (*overrides, f"pivot%radius_difference={difference}e-6")))
    for law, overrides in LAWS.items()
    for difference in LAW_DIFFERENCES
    for friction in (False, True)
)  # fmt: skip

#: Balance grades at 6500 rpm, and speeds at which rule (26) takes that speed or 6500 rpm.
GRADES = (0.4, 1, 2.5, 4, 6.3, 10)
RULE_SPEEDS = tuple(range(1500, 8501, 500))
RULE_SCENES = tuple(
    shorter(Scene(f"rule_{model}_{kind}_{value:g}", case, overrides))
    for model, case in (("none", FRICTIONLESS), ("lugre", LUGRE))
    for kind, values, make in (
        ("grade", GRADES, lambda grade: at_speed(6500, grade)),
        ("own", RULE_SPEEDS, at_speed),
        ("highest", RULE_SPEEDS, lambda speed: (*at_speed(speed), "rotor%balance_speed_rpm=6500")),
    )
    for value in values
    for overrides in [make(value)]
)


#: What sticking does to stability: the rotor's mass and other masses, kg, speeds, rpm, and bristle
#: stiffnesses, 1/m. Thresholds are sought from the first speed up to THRESHOLD_UP_TO.
ROTOR_MASS = 2000
STICK_MASSES = (100, 200, 400, 700, 1000, 1500, 2000, 3000, 4000)
STICK_SPEEDS = tuple(range(1000, 12001, 1000))
STICK_STIFFNESSES = ("1e4", "3e4", "1e5", "2e5", "5e5", "1e6", "2e6", "5e6", "2e7", "1e8")
THRESHOLD_UP_TO = 30000
#: Speeds of the marches, rpm, below and above the threshold of the paper's rotor on pads that stick.
WHIRL_SPEEDS = (8600, 9600)
WHIRL = (
    "rotor%unbalance=0",
    "start%journal=2e-7,0",
    "operation%duration=0.6",
    "output%samples_per_revolution=60",
    "integration%relative_tolerance=1e-7",
)
THRESHOLD = (
    "case%task=coefficients",
    f"operation%speed_rpm={STICK_SPEEDS[0]}",
    f"coefficients%threshold_up_to_rpm={THRESHOLD_UP_TO}",
)


def stick_name(mass: float, speed: float) -> str:
    return f"stick_{mass}_{speed}"


STICK_SCENES = (
    *(
        Scene(
            stick_name(mass, speed),
            LUGRE,
            ("case%task=coefficients", f"rotor%mass={mass}", f"operation%speed_rpm={speed}"),
        )
        for mass, speed in (*product(STICK_MASSES, STICK_SPEEDS), *product([ROTOR_MASS], WHIRL_SPEEDS))
    ),
    *(Scene(f"threshold_mass_{mass}", LUGRE, (*THRESHOLD, f"rotor%mass={mass}")) for mass in STICK_MASSES),
    *(
        Scene(f"threshold_stiffness_{word}", LUGRE, (*THRESHOLD, f"friction%bristle_stiffness={word}"))
        for word in STICK_STIFFNESSES
    ),
    *(Scene(f"whirl_{speed}", LUGRE, (*WHIRL, f"operation%speed_rpm={speed}")) for speed in WHIRL_SPEEDS),
)

#: Branches of the synchronous orbit over the speed, rpm: laws of friction, static coefficients, the dynamic
#: ones half as large, and unbalances, kg m; that of Table 1 last.
LOST_LAWS = {"LuGre": LUGRE, "Bengisu-Akay": BA}
LOST_COEFFICIENTS = (0.02, 0.05, 0.075, 0.1, 0.15, 0.2, 0.3)
LOST_UNBALANCES = (0.001, 0.010)
LOST_SPEEDS = (2000, 14000)


def over_speed(first: float, last: float, *, step: float, longest: float) -> tuple[str, ...]:
    """Overrides of a branch of orbits over the speed."""
    return (
        "case%task=branch",
        'branch%parameter="operation%speed_rpm"',
        f"operation%speed_rpm={first:g}",
        f"branch%last={last:g}",
        f"branch%step={step:g}",
        f"branch%max_step={longest:g}",
        "branch%switch=.false.",
    )


def lost_name(law: str, unbalance: float, coefficient: float) -> str:
    return f"lost_{law}_{unbalance:g}_{coefficient:g}"


#: The four-pad bearing: its synchronous orbit, and that of two revolutions, down from where it is found and
#: back again; speeds of its marches up and down.
FOUR = "input/examples/four_pads.nml"
FOUR_SPEEDS = (4000, 8500)
DOUBLED = ("periodic%revolutions=2", "branch%max_points=125", 'case%title="two revolutions"')
LOST_SCENES = (
    *(
        Scene(
            lost_name(law, unbalance, f),
            case,
            (
                f"rotor%unbalance={unbalance:g}",
                *coefficients(f, f / 2),
                *over_speed(*LOST_SPEEDS, step=100, longest=500),
            ),
        )
        for law, case in LOST_LAWS.items()
        for unbalance in LOST_UNBALANCES
        for f in LOST_COEFFICIENTS
    ),
    Scene("lost_none", FRICTIONLESS, over_speed(*LOST_SPEEDS, step=100, longest=500)),
    Scene(
        "four_once", FOUR, (*over_speed(*FOUR_SPEEDS, step=50, longest=250), 'case%title="one revolution"')
    ),
    Scene("four_twice", FOUR, (*over_speed(6700, 5000, step=-50, longest=250), *DOUBLED)),
)

#: The runs of the figures and claims; again with a finer film and by rule (26); and the studies'.
SCENES = (*PAPER, *FIGURES_7_8, *SLOW, *UPPER_PADS)
STUDIES = (*MAP, *LAW_SCENES, *RULE_SCENES, *STICK_SCENES, *LOST_SCENES)
#: Folders of the runs, with their scenes.
FOLDERS = {
    "paper": tuple(map(kept, SCENES)),
    "refined": tuple(map(refined, SCENES)),
    "rule": tuple(map(balanced, SCENES)),
    "studies": STUDIES,
}
