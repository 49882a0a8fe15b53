"""Parts of the page: quotations from the paper, and their pictures."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Section:
    """A part of the page: pictures, with what they show for those who cannot see them, a quotation from the
    paper, and the figures or sections of its claims.
    """

    title: str
    pictures: dict[str, str]
    quote: str
    where: tuple[str, ...] = ()
    note: str = ""


SECTIONS = (
    Section(
        "Figs. 3 and 4: contact",
        {"3": "Contact pressure over the projected contact", "4": "Force over pivot deflection"},
        "the pressure field generated in the BS coupling is shown in Fig. 3. [...] The resulting force "
        "generated in the BS coupling for various radius differences is shown in Fig. 4. [...] It is "
        "supposed that the snug fit [...] is the stiffest option.",
        ("Fig. 4",),
        "Ball and socket are of steel, R_2 = 100 mm. The paper does not print the load of Fig. 3 and "
        "the radius differences of Fig. 4.",
    ),
    Section(
        "Fig. 6: friction laws",
        {"6": "Friction coefficient over velocity"},
        "for gamma = 1, which is our setting, the resulting Stribeck curve is equal for both studied "
        "models, so the results are comparable.",
        ("Fig. 6",),
    ),
    Section(
        "Fig. 7: critical velocity",
        {"7": "Tilt rate for several critical velocities"},
        "For v_c = 0.001 m/s only sliding friction occurs, while with lower values the friction sticking "
        "is more apparent.",
        ("Fig. 7",),
    ),
    Section(
        "Fig. 8: bristle stiffness",
        {"8": "Tilt rate for several bristle stiffnesses"},
        "For lower sigma_0 almost no sticking occurs, while with higher sigma_0 the sticking phenomena "
        "together with presliding behaviour appear. [...] with a further increase of sigma_0 the results "
        "do not differ significantly and only the required CPU time increases.",
        ("Fig. 8", "Sec. 3.1"),
    ),
    Section(
        "Fig. 9: radial motion of the pads",
        {"9": "Orbit, tilt and tilt rate, TO and TR"},
        "the TO model yields smaller journal orbits than the TR model. At the same time, the orbits are "
        "located higher compared to the TR model. [...] the journal orbit gets larger in both cases "
        "[with friction]. [...] the larger influence of friction occurs in the TR case",
        ("Fig. 9", "Sec. 4.1"),
    ),
    Section(
        "Fig. 10: radius difference",
        {"10": "Orbit, tilt and tilt rate for several radius differences"},
        "the journal moves downwards significantly with the increasing radius difference [...] The "
        "peak-to-peak amplitudes of the tilting angle and velocity displacement increase with the radius "
        "difference [...] Therefore, the journal can perform larger orbital motions when the radius "
        "difference increases. [...] When friction is applied using the Bengisu-Akay model, the "
        "waveforms flatten due to the sticking phenomenon",
        ("Fig. 10",),
    ),
    Section(
        "Figs. 11, 12 and 13: friction coefficients",
        {
            "11": "Orbit, tilt rate and hysteresis, Bengisu-Akay",
            "12": "Orbit, tilt rate and hysteresis, LuGre 1e6",
            "13": "Orbit, tilt rate and hysteresis, LuGre 5e6",
        },
        "with the increasing values of friction coefficients, the journal orbit is slightly larger. "
        "[...] The journal orbits for both friction models are comparable in size and shape. [...] With "
        "the increase in friction coefficients, the sticking phenomenon areas are wider, and the "
        "amplitudes of the pad tilting velocities decrease. [...] the amplitude of the pad tilting "
        "velocity decreases more than in the case of the Bengisu-Akay friction model. [...] With a "
        "further increase of sigma_0, the resulting pad tilting velocity curve shape is getting closer "
        "to the results obtained using the Bengisu-Akay model.",
        ("Figs. 11-13", "Figs. 11-12", "Fig. 11", "Fig. 12", "Fig. 13"),
        "The pictures are for Bengisu-Akay, for LuGre with 1e6 1/m and for LuGre with 5e6 1/m. The "
        "paper does not print its pairs of friction coefficients; the pairs here cover its range.",
    ),
    Section(
        "Fig. 14: friction characteristics",
        {"14": "Friction characteristics"},
        "The resulting curve exactly corresponds to the used Stribeck curve in the case of the "
        "Bengisu-Akay model, while in the case of the LuGre model, the hysteresis behaviour is present. "
        "The typical friction curve loops appear in the case of a higher sigma_0, while with the lower "
        "sigma_0 this phenomenon is not significant.",
        ("Fig. 14",),
    ),
    Section(
        "Section 4: low speed and small unbalance",
        {},
        "For lower speeds, small unbalance forces generate a small journal orbit and a small tilting "
        "motion of the pad. Hence, the pads remain in the sticking regime. Similarly, the lower "
        "unbalance causes a stick in the BS coupling concerning the given nominal rotor speed.",
        ("Sec. 4",),
        "The map further down shows up to which speed they stick, for each friction coefficient.",
    ),
    Section(
        "Section 3: the upper pads",
        {"pads": "Orbit with two and four pads, tilt and pivot load of the upper pads"},
        "only two lower pads are considered, and we neglect the influence of upper pads. [...] the upper "
        "pads do not have a load-carrying function [...] and they are, under some conditions, even "
        "subjected to pad fluttering.",
        ("Sec. 3",),
        "Both runs have LuGre friction 0.1/0.05 and cavitation 'gumbel'.",
    ),
    Section(
        "Fig. 15: run-up",
        {"15": "Run-up"},
        "There is an apparent deviation in the journal trajectory for the LuGre model compared to the "
        "Bengisu-Akay model at lower rotor speed. A higher parameter value sigma_0 strengthens the "
        "deviation [...] However, the journal orbits at 6500 rpm are comparable. [...] the results for "
        "sigma_0 = 1e6 1/m are different from the Bengisu-Akay model and higher sigma_0 at lower rotor "
        "speed.",
        ("Fig. 15",),
        "The upper panels show the whole run (grey: the path with Bengisu-Akay friction), the lower ones "
        "revolutions at low and at high speed.",
    ),
)
