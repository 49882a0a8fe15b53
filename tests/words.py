"""Finds words that are not those of the field, and says which standard term stands for each.

usage: words.py [--count] [PATH...]     --count: only how many there are of each

Every offence is one line, "file:line: word: say ...". Names of files are checked like lines. Files of ALIASES
may name an old word beside the new one.
"""

import re
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

PATHS = ("src_f90", "post", "tests", "docs", "input", "README.md", "Makefile", "CITATION.cff")
ENDINGS = {".f90", ".F90", ".c", ".py", ".md", ".nml", ".sh", ".awk", ".bash", ".ipynb", ".cff", ".toml", ""}
#: Files that must know old words, and what nobody here wrote.
ALIASES = (
    *("tests/words.py", "tests/cases/test_words.py", "former_names.py", "case_parameter.f90"),
    *("seeds.jsonl", "LICENSE"),
)
ALIAS = re.compile(r"\balias(?:es)?\b|\bnow\)", re.IGNORECASE)

#: What a word stands for today: pattern (in any case of letters), standard term, and what excuses a line.
WORDS = {
    "full film": (r"whole[ _-]films?\b|\bwhole_table\b|films? (?:is|are|was|were|stays?) whole", ""),
    "cavitated film; 'rupture' only for its boundary": (
        r"\b\w*ruptur\w*",
        r"rupture boundar|rupture_boundar|conditions? of rupture",
    ),
    "rupture boundary": (r"\bfilm_rim\b|\brims? of (?:a|the) (?:\w+ )?film", ""),
    "reformation boundary": (r"\bforms? again\b", ""),
    # what stands still is at rest, and a pad that sticks comes to rest; a bearing has an equilibrium
    "equilibrium; pad, thermal equilibrium; without equilibrium": (
        r"\b\w*pad_rest\w*|\brestless\b|\bresting\w*|\b\w*warm_rest\b|\brests\b|\b\w*_to_rest\b|"
        r"\b(?:bearings?|journal|model|equilibrium|orbits?|temperatures?|viscosit\w+) (?:\w+ )?"
        r"(?:at|to) rest\b|\brest (?:position|point|state)s?\b|"
        r"\b(?:no|own|every|static|warm|cold|same|one|a|without) rests?\b|"
        r"\b(?:the|a) rests? of (?:a |an |the |one |most |its |all |each )?(?:unloaded )?"
        r"(?:pads?|journal|bearing|model)\b",
        "",
    ),
    "oscillatory instability (Hopf); 'flutter' of pads alone": (
        r"\bfluttering(?:_\w+)?\b|\b(?:equilibri(?:um|a)|bearings?|journals?|cases?)\b[^.,;]* flutter\w*",
        r"pads?\b|_pad|pad_",
    ),
    "static instability (divergence)": (r"\bdivergent\b", r"diverging film|divergent (?:film|gap|wedge)"),
    "switching point; event mesh": (r"\b\w*kinks?(?:\b|_\w+)", ""),
    "df_dt": (r"\bprocedure[^!]*:: *drive\b|\bsubroutine drive\((?=\w)|%drive\((?=t\b)", ""),
    "rhs_and_jacobian": (r"\bprocedure[^!]*:: *tangent\b|\bsubroutine tangent\b|=> tangent\b", ""),
    "effective velocity (wedge and squeeze)": (r"\b\w*ruptured_drive\w*", ""),
    "characteristic scales, state_scales": (r"\bnatural[ _]sizes?\b|\bnatural[ _]scales?\b", ""),
    "viscosity_history": (r"\b\w*viscosity_course\w*|\b(?:a|the|as) course\b|\bcourse over\b|\bcourse%", ""),
    "groove thermal transient": (r"\b\w*groove_course\w*", ""),
    "branch_progress": (r"\b\w*branch_course\w*", ""),
    "mid-arc frame": (r"\bmiddle_frame\b|\bframe of (?:the|its) (?:pad's )?middle\b", ""),
    "dimensionless pad": (r"\b\w*unit_pad\w*", ""),
    "logarithmic grid": (r"\b(?:module|use|test_)_? ?octaves\b", ""),
    "film-adapted grid": (r"\b\w*following_volumes\w*|\bvolumes that follow\b", ""),
    "SIMD padding": (r"\bwhole[ _]vectors?\b|\blanes?\b", ""),
    "solve_2x2": (r"\b\w*two_equations\b|\btwo linear equations\b", ""),
    "march to equilibrium": (r"\bmotion_to_rest\b", ""),
    "pseudo-transient continuation": (r"\b\w*damped[ _]newton\b|\bdamped Newton", ""),
    "backtracking Newton": (r"\b\w*shortened[ _]newton\b|\bshortened Newton", ""),
    "thermal equilibrium": (r"\b(?:module|use) warm_\w+|\bwarm_rest\w*", ""),
    "frozen viscosity": (r"\b\w*resting_oil\w*", ""),
    "heat balance equations": (r"\b\w*oil_equations\w*", ""),
    "bifurcation points": (r"\b\w*special[ _]points?\b", ""),
    "period doubling (flip beside it)": (r"\bflips?\b", r"period doubling"),
    "period multiple": (r"%turns\b|\borbits? of (?:\w+ ){1,3}turns\b|\bturns of (?:the|an) orbit\b", ""),
    "torus (Neimark-Sacker) bifurcation": (r"\ba second frequency\b", r"torus"),
    "pad diagnostics": (r"\b\w*pad_remarks\b", ""),
    "order control": (r"\b\w*order_watch\w*", ""),
    "local cavitation correction": (r"\b\w*slight_rupture\w*|\bslight rupture\b", ""),
    "guarded open": (r"\b\w*hdf5_trial\b", ""),
    "film validity": (r"\b\w*pad_admission\b|\badmission\b", ""),
    "bearing construction": (r"\b\w*bearing_parts\b", ""),
    "factories": (r"\buse components\b|\bmodule components\b|`components`|bearing/components\b", ""),
    # the input group is called sweep, and so are the example with it, the job script and what the file says
    "parameter study (input); SOR sweep; forward and backward pass": (
        r"\b\w*(?<![&/'\"`_.])(?:\bsweep|_sweep)(?:s|_\w+|ing)?\b(?!%|/|\.(?:nml|sh|h5)|[\"'`]|-study|=[{\"s])|"
        r"\bswept\w*",
        r"&sweep|sor_film|sor_sweeps|SOR sweep|max_sweeps|static_sweeps|\bsor\b|over-relaxation|red-black|"
        r"film_bench|peer_model|(?:be|is) swept|'swept'|\"swept\"|did you mean|sweep=f\"|collect sweep",
    ),
    "case": (r"\b\w*scenes?(?:\b|_\w+)", ""),
    "run (of a study)": (
        r"\bmembers?(?:\b|_\w+)",
        r"h5gn_members|--member|CFI_cdesc_t|members\.csv|src_f90/storage/",
    ),
    "axial Fourier expansion": (r"\bmodal(?:\b|_\w+)", r"modal[ _](?:assurance|mass|stiffness|damping)"),
    "bearing clearance c_b": (r"\bassembled clearance\b", r"bearing clearance"),
    "pad clearance c_p": (r"\bmachined clearance\b", r"pad clearance"),
    "pivot offset": (r"\bpivot ratio\b", ""),
    "pivot deflection": (r"\b\w*penetrations?(?:\b|_\w+)", "pivot%penetration_factor"),
    "pivot load": (r"\bcontact[ _]forces?\b", ""),
    "synchronously reduced coefficients": (r"\bsynchronous coefficients?\b", ""),
    "threshold speed of instability": (
        r"\b(?:a|the|its|this|that|above|below|no) thresholds?\b(?! speeds?\b| of (?:in)?stability)",
        r"threshold speed|thresholds? of (?:in)?stability",
    ),
    "locked pads (no tilt)": (r"\blocked pivots?\b|\bpivots? (?:is|are) locked\b", ""),
    "Couette loss": (r"\bloss by shear\b|\bshear loss\b", ""),
    "Poiseuille loss": (r"\bloss by pressure\b|\bpressure_loss\b", ""),
    "Nusselt number of film to shaft": (r"\bwall_exchange\b", ""),
    "film thickness ratio": (r"\binclination\b", ""),
    "0.5x": (r"[\"']half of it[\"']", ""),
    "Bode plot (1x over speed)": (r"\borders plot\b", ""),
    "the quantity or the action": (
        r"\b(?:patience|take_up|blame_oil|mind_checkpoint|widen)\b|\b(?:subroutine|call|def|import) judge\b|"
        r"::.*\b(?:few|near|wide)\b(?=\s*(?:,|=|\(|$))",
        "",
    ),
    "an ordinary sentence": (
        r"\bthat which\b|\bso many\b(?! as)|\b(?:is|are) told by\b|\bas far as\b|\bwhite metal stand\b",
        "",
    ),
}
COMPILED = [
    (re.compile(word, re.IGNORECASE), term, excuse and re.compile(excuse, re.IGNORECASE))
    for term, (word, excuse) in WORDS.items()
]
#: What a whole text in small letters has where one of its lines has the word: without the starts of words,
#: which make the search slow.
START = re.compile(r"\\b\\w\*|(?<![^|(:])\\b")
HINTS = [re.compile(START.sub("", word).lower(), re.MULTILINE) for word, _ in WORDS.values()]


def offences(text: str, path: str = "") -> Iterator[tuple[int, str, str]]:
    """Line, word and standard term of what a text has to say otherwise; lines that name an alias may.

    A word is excused by its line, or by the name of its file.
    """
    small = text.lower()
    there = [each for each, hint in zip(COMPILED, HINTS, strict=True) if hint.search(small)]
    for number, line in enumerate(text.splitlines() if there else [], 1):
        if ALIAS.search(line):
            continue
        for word, term, excuse in there:
            if not (excuse and excuse.search(f"{path}: {line}")):
                yield from ((number, found[0].strip(), term) for found in word.finditer(line))


def files(paths: list[str]) -> Iterator[Path]:
    """The texts below some paths."""
    for path in map(Path, paths):
        for each in sorted(path.rglob("*")) if path.is_dir() else [path]:
            inside = each.relative_to(path).parts if path.is_dir() else ()
            # what tools leave behind, as .ruff_cache, is nobody's text
            hidden = any(part.startswith(".") or ".egg-info" in part for part in inside)
            known = each.suffix in ENDINGS and not str(each).endswith(ALIASES)
            if known and not hidden and each.is_file():
                yield each


def main() -> int:
    """Prints what is found, and how often; 1 where something is."""
    words = sys.argv[1:]
    found = Counter()
    for path in files([word for word in words if word != "--count"] or list(PATHS)):
        named = [(0, word, term) for _, word, term in offences(str(path), str(path))]
        for number, word, term in [*named, *offences(path.read_text(), str(path))]:
            found[term] += 1
            if "--count" not in words:
                print(f"{path}:{number}: {word}: say {term}")
    for term, count in found.most_common():
        print(f"{count:6}  {term}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
