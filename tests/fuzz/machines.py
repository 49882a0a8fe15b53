"""Random machines that must be accepted: a shaft in two to four bearings with groups of their own."""

from random import Random

from harness import Case

NAME = "abcdefghijklmnopqrstuvwxyz_0123456789"
#: What a bearing may have of its own, or all of them.
OWN = (
    "&pads {}arc_deg=60.5 /",
    "&pads {}pivot_angle_deg=-90, 0, 90, 180, arc_deg=4*70 /",
    "&pads {}motion='tilting_only' /",
    "&pads {}motion='fixed' /",
    "&pivot {}law='hertz' /",
    "&friction {}static_coefficient=0.2 /",
    "&asperity {}model='none' /",
    "&film {}cavitation='gumbel' /",
    "&oil {}grade=46, supply_temperature=41.5 /",
    "&support {}mass=3.5, stiffness=1e8, 2e9, damping=2*1e3 /",
)


def draw(dice: Random) -> Case:
    """A machine in a case, some of its values by --set."""
    stations = dice.randint(3, 8)
    groups = ["&shaft length=" + _numbers(dice, stations - 1, 0.01, 2)]
    groups[0] += ", diameter=" + _numbers(dice, stations - 1, 0.2, 1) + dice.choice((" /", ", bore=0.1 /"))
    for _ in range(dice.randint(0, 3)):
        at = dice.randint(1, stations)
        groups.append(
            f"&disc station={at}, mass={dice.uniform(0, 1e3)!r}, polar_inertia=2, diametral_inertia=1 /"
        )
    for _ in range(dice.randint(0, 2)):
        at = dice.randint(1, stations)
        groups.append(
            f"&unbalance station={at}, moment={dice.random()!r}, angle_deg={dice.uniform(-360, 360)!r} /"
        )
    if dice.random() < 0.3:
        groups.append(f"&load force={_numbers(dice, 2, -1e4, 1e4)} station={dice.randint(1, stations)} /")
    if dice.random() < 0.3:
        ends = dice.sample(range(1, stations + 1), 2)
        groups.append(
            f"&element station={ends[0]}{dice.choice((f', to_station={ends[1]}', ''))}, "
            f"stiffness={_numbers(dice, 4, -1e7, 1e7)}, damping={_numbers(dice, 4, 0, 1e4)}, mass=1, 2*0, 1, "
            f"cross_stiffness={dice.uniform(-1e7, 1e7)!r}, static={dice.choice(('.true.', '.false.'))} /"
        )
    if dice.random() < 0.2:
        groups.append(
            f"&impeller station={dice.randint(1, stations)}, power={dice.uniform(1, 1e6)!r}, diameter=0.3, "
            f"width=0.02, {dice.choice(('suction_density=9, discharge_density=12.5', 'kind=axial'))} /"
        )
        groups += dice.choice(([], ["&lateral probe_station=1, 2, clearance_change=-1e-6, 2e-6 /"]))
    if dice.random() < 0.3:
        groups.append(f"&reduction frequency={dice.uniform(1, 1e4)!r}, damp_above=1e3 /")
    names: set[str] = set()
    places = dice.sample(range(1, stations + 1), dice.randint(2, min(4, stations)))
    while len(names) < len(places):
        names.add("b" + "".join(dice.choices(NAME, k=dice.choice((0, 1, 5, 29)))))
    for name, place in zip(sorted(names), places, strict=True):
        groups.append(
            f"&bearing name='{_cased(dice, name)}', station={place}, offset=0, {dice.uniform(-0.1, 0.1)!r}"
            + dice.choice((" /", ", shaft_slope='film', misalignment=1e-4, -1e-4 /"))
        )
    for name in ("", *sorted(names)):
        own = {group.split()[0]: group for group in dice.sample(OWN, dice.randint(0, 3))}
        heading = f"bearing = '{_cased(dice, name)}', " if name else ""
        groups += [group.format(heading) for group in own.values()]
    dice.shuffle(groups)
    sets = ("shaft%density=7000", f"pads:{dice.choice(sorted(names))}%density=7850", "film%axial_cells=20")
    text = dice.choice((" ", "\n", "\n\n")).join(groups)
    return Case(text.encode(), tuple(each.encode() for each in dice.sample(sets, dice.randint(0, 1))))


def _numbers(dice: Random, count: int, low: float, high: float) -> str:
    return ", ".join(repr(dice.uniform(low, high)) for _ in range(count))


def _cased(dice: Random, name: str) -> str:
    """Names do not distinguish capitals."""
    return "".join(dice.choice((letter, letter.upper())) for letter in name)
