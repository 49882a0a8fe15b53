"""The commands tiltpad-plot, tiltpad-report and tiltpad-collect."""

import argparse
import errno
import gc
import io
import logging
import os
import signal
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any, NoReturn

from tiltpad.calculate.critical_speeds import critical_speeds, operating_range, write_critical_speeds
from tiltpad.calculate.library import LibraryError, MissingLibraryError
from tiltpad.calculate.selection import ArgumentError
from tiltpad.calculate.tables import write_coefficients
from tiltpad.collect.collect import RunWarning
from tiltpad.collect.collect import collect as collected
from tiltpad.files import writing
from tiltpad.files.archive import NotInRunError, RunError, meant
from tiltpad.files.read import IncompleteRunWarning, Run, read
from tiltpad.files.station import Station
from tiltpad.files.study import Study, read_either, read_study
from tiltpad.running import resolved

FORMATS = ("png", "pdf", "svg")
#: The plots that can be tables, too: of coefficients, and of critical speeds; their formats.
COEFFICIENTS, RESPONSE = "coefficients", "response"
TABLES = {COEFFICIENTS: ("csv", "toml"), RESPONSE: ("csv",)}
#: The plot of a study; those of the bearing itself, of a case or a result, and of its motion.
STUDY, BEARING, MOVIE = "study", "bearing", "movie"
#: Formats of a movie.
MOVIES = ("gif", "mp4")
#: Plots of coefficients and modes: of results, and of studies.
VIBRATIONS = ("coefficients", "stability", "campbell")
#: Plots of results and of studies.
OF_EITHER = (*VIBRATIONS, RESPONSE, "temperatures")
#: Plots of studies of samples.
SAMPLES = ("tornado", "distribution", "scatter")
#: The plot of branches, below which studies may lie.
BRANCH = "branch"
#: The plot of curves over two parameters.
CHART = "chart"
#: The plot of a study of starts and a branch of limit cycles.
BASIN = "basin"
#: Plots of a machine; MACHINE is that of a case or a result, drawn to scale.
MACHINE, STATIONS, SHAFT, SHAPES = "machine", "stations", "shaft", "shapes"
OF_MACHINES = (MACHINE, STATIONS, SHAFT, SHAPES)
#: Plots of what a machine has as a whole, which the result of any of its bearings has, too.
OF_WHOLE = ("multipliers", CHART)
#: Plots of a motion that stations of a shaft have as a journal has; of a machine without films these alone.
OF_STATIONS = (BRANCH, "spectrum", "poincare", "size", "orders", "waterfall")
#: Plots that need a film or a pad.
OF_FILMS = (
    *("orbit", "equilibrium", "waveform", "runup", "hysteresis", "friction", "sticking", "pressure", "film"),
    *("turbulence", "temperatures", COEFFICIENTS, BASIN, BEARING, MOVIE),
)
#: Options of some plots alone.
OWN_OPTIONS = {
    "time": ("pressure", "film"),
    "orders": ("spectrum", "waterfall"),
    "scale": ("orders",),
    **dict.fromkeys(("by", "decades"), ("waterfall",)),
    "kind": (STUDY,),
    "show": (STUDY, *SAMPLES),
    "over": (STUDY, *OF_EITHER),
    "where": (STUDY, *OF_EITHER, *SAMPLES),
    "pivot": (STUDY, *VIBRATIONS, RESPONSE, *SAMPLES, SHAPES),
    "station": (STATIONS, RESPONSE, *OF_STATIONS),
    "operating": (RESPONSE,),
}
#: Plots without the options --last and --pad.
WITHOUT_LAST = (
    *("equilibrium", "runup", "orders", "waterfall", "pressure", "film", "turbulence", BEARING, STUDY),
    *(BRANCH, BASIN, CHART, *OF_EITHER, *SAMPLES, MACHINE, SHAFT, SHAPES),
)
WITHOUT_PAD = (BASIN, BEARING, MOVIE, CHART, *VIBRATIONS, RESPONSE, *OF_MACHINES)
#: Plots without the option --bearing.
WITHOUT_BEARING = (STUDY, *SAMPLES, *OF_MACHINES)
#: What the speeds are for from which critical speeds must keep away.
OPERATING = "critical speeds: operating speed, or LOW:HIGH, that they keep a margin from"
#: New objects after which Python looks for those that nothing refers to.
OBJECTS = 50_000
#: Exit status, as the program's own.
INPUT_ERROR, FILE_ERROR = 1, 3

PLOTS = {
    "orbit": "path of the journal in its clearance circle, and enlarged (last revolution)",
    "equilibrium": "equilibrium of the journal in its clearance circle",
    "size": "peak-to-peak of the journal: of one run, over a variable that differs between runs, or speed",
    "poincare": "journal and one pad, once per revolution (last 50 revolutions, pad 1)",
    "waveform": "journal, tilt and tilt rate over the last revolutions (5)",
    "multipliers": "Floquet multipliers of a periodic orbit, or of branches, and the unit circle",
    "spectrum": "amplitudes of the journal, one-sided and full, at constant speed (from the file)",
    "hysteresis": "friction moment over pad tilt, one panel per pad (last revolution)",
    "friction": "friction coefficient over sliding velocity, one panel per pad (last revolution)",
    "sticking": "tilt rate, with a bold line where the pivot sticks, one panel per pad (last 2 revolutions)",
    "runup": "journal, tilt and minimum film thickness over the whole run, with the speed",
    "orders": "amplitude and phase of the first orders over the speed of a run-up (--pad: also of its tilt)",
    "waterfall": "amplitudes over speed and frequency of a run-up (of the journal; --pad: of its tilt)",
    "pressure": "film pressure over the unrolled pads at one instant (--time; default: at the equilibrium)",
    "branch": "branches over their parameter, stable or not (--pad: its tilt), over studies of marches",
    "chart": "stability chart: curves of bifurcation points over two parameters, with their stable side",
    "basin": "starts of a study that whirl or return, and the unstable cycle of a branch of limit cycles",
    "response": "first harmonic, critical speeds, amplification: studies, run-ups, branches (also .csv)",
    "temperatures": "temperatures and viscosity of the pads: studies, a branch; heat balances of results",
    "film": "thickness and pressure of the films around the bearing at one instant (likewise)",
    "turbulence": "local Reynolds number over the arc of each pad at the equilibrium, and the transition",
    "bearing": "the bearing of a case (.nml) or result: pads, pivots, angles, load, sense of rotation",
    "machine": "a machine of a case (.nml) or result to scale: shaft, discs, bearings, unbalances, loads",
    "stations": "orbits of the shaft of machines at stations (--station; last revolution)",
    "shaft": "deflection of the shaft of machines at the equilibrium, with the loads of the bearings",
    "shapes": "mode shapes of the shaft of a machine, forward or backward, in space (--pivot)",
    "movie": "journal and pads in motion, as .gif or .mp4 (last 2 revolutions)",
    "coefficients": "stiffness and damping over speed, of one result over whirl frequency (also .csv, .toml)",
    "stability": "damping ratio and logarithmic decrement of the modes, of studies and results",
    "campbell": "frequencies of the modes over the speed, of studies",
    "study": "results over parameters, of studies (--show, --over, --as, --where)",
    "tornado": "which input of a sampled study matters for a result: Sobol indices (--show)",
    "distribution": "histograms and percentiles of the results of sampled studies (--show)",
    "scatter": "results of a sampled study over its inputs, a point for each run (--show)",
}


class Parser(argparse.ArgumentParser):
    """One line and the program's own exit status for a wrong command line."""

    def error(self, message: str) -> NoReturn:
        sys.exit(complain(self.prog, f"{message}; see {self.prog} --help", INPUT_ERROR))


def main(arguments: Sequence[str] | None = None) -> int:
    """tiltpad-plot: draws what the command line asks for; gives the exit status."""
    options = plot_parser().parse_args(arguments)
    suffix = MOVIES[0] if options.plot == MOVIE else FORMATS[0]
    output = Path(options.output or f"{Path(options.files[0]).stem}-{options.plot}.{suffix}")
    return finished("tiltpad-plot", output, lambda: draw(options, output))


def report(arguments: Sequence[str] | None = None) -> int:
    """tiltpad-report: writes the page about a run; gives the exit status."""
    options = report_parser().parse_args(arguments)
    ending = "-lateral.html" if options.lateral else ".html"
    output = Path(options.output or f"{Path(options.file).stem}{ending}")
    if not options.lateral:
        return finished(
            "tiltpad-report", output, lambda: write_report(options.file, output, options.operating)
        )
    if options.operating is not None:
        wrong = "--operating: not with --lateral; the case has the operating speeds"
        return complain("tiltpad-report", wrong, INPUT_ERROR)
    return finished("tiltpad-report", output, lambda: write_lateral_report(options.file, output))


def collect(arguments: Sequence[str] | None = None) -> int:
    """tiltpad-collect: writes the study of many runs; gives the exit status."""
    options = collect_parser().parse_args(arguments)
    target = options.output or "the study"
    return finished("tiltpad-collect", target, lambda: tell(collected(options.paths, options.output)))


def tell(result: object) -> None:
    """Prints it; raises RunError if standard output cannot be written."""
    writing.look()
    try:
        print(result, flush=True)
    except OSError as error:
        # Python would try again at its end to write the rest of the buffer
        sys.stdout = None
        raise RunError(f"standard output cannot be written: {error.strerror}") from error


def tell_remarks(sources: Sequence[Run | Study]) -> None:
    """Says of each file that it has remarks: how many, of a study on how many runs."""
    for each in sources:
        if isinstance(each, Run):
            if count := len(each.remarks):
                tell(f"{each.path}: {count} remark{'s' * (count > 1)}; the report of the run has them")
        elif remarked := int(each.remarked.sum()):
            runs = each.length("run")
            tell(f"{each.path}: remarks on {remarked} of {runs} runs; the report of the study counts them")


def finished(command: str, output: Path | str, work: Callable[[], None]) -> int:
    """Does the work and gives the exit status; errors and warnings are a line each."""
    # objects of pictures live to the end: looking for others after each 700 takes a twentieth of the time
    gc.set_threshold(OBJECTS)
    try:
        with warnings.catch_warnings(), signals_stop():
            warnings.simplefilter("ignore")
            for category in (IncompleteRunWarning, RunWarning):
                warnings.simplefilter("always", category)
            warnings.showwarning = lambda message, *_: tell_error(command, f"warning: {message}")
            work()
    except ArgumentError as error:
        return complain(command, error.of_command(), INPUT_ERROR)
    except (ValueError, NotInRunError) as error:
        return complain(command, error, INPUT_ERROR)
    except (RunError, MissingLibraryError) as error:
        return complain(command, error, FILE_ERROR)
    except LibraryError as error:
        return complain(command, error, error.status)
    except OSError as error:
        reason = os.strerror(error.errno) if error.errno else error
        return complain(command, f"{output}: cannot be written: {reason}", FILE_ERROR)
    except MemoryError:
        return complain(command, "not enough memory", FILE_ERROR)
    except KeyboardInterrupt as stop:
        return complain(command, "stopped", 128 + (stop.args or (signal.SIGINT,))[0])
    except Exception as error:
        said = " ".join(f"{error}".split())
        text = f"please report this error of the program: {type(error).__name__}: {said}"
        return complain(command, text, FILE_ERROR)
    return 0


@contextmanager
def signals_stop() -> Iterator[None]:
    """Lets the signals that end a process stop the work as Ctrl-C does, so that nothing is left of it.

    Where Python ignores the exception of the handler (writing.look), its message about that is left out.
    """

    def stop(number: int, _: object) -> NoReturn:
        writing.came.append(number)
        raise KeyboardInterrupt(number)

    ending = (each for each in (signal.SIGTERM, signal.SIGHUP) if signal.getsignal(each) == signal.SIG_DFL)
    former = {each: signal.signal(each, stop) for each in ending}
    told = sys.unraisablehook
    sys.unraisablehook = lambda what: None if writing.came else told(what)
    try:
        yield
        writing.look()
    finally:
        sys.unraisablehook = told
        writing.came.clear()
        for each, handler in former.items():
            signal.signal(each, handler)


def draw(options: argparse.Namespace, output: Path) -> None:
    """Reads the runs, draws them and writes the picture."""
    tables = TABLES.get(options.plot, ())
    form = needs_suffix(output, MOVIES if options.plot == MOVIE else FORMATS + tables)
    for name, allowed in OWN_OPTIONS.items():
        if getattr(options, name) is not None and options.plot not in allowed:
            option = {"kind": "as"}.get(name, name)
            words = f"the plot {allowed[0]}" if len(allowed) == 1 else f"the plots {', '.join(allowed)}"
            raise ValueError(f"--{option}: for {words}, not for {options.plot}")
    without_options = {"last": WITHOUT_LAST, "pad": WITHOUT_PAD, "bearing": WITHOUT_BEARING}
    for name, without in without_options.items():
        if getattr(options, name) is not None and options.plot in without:
            raise ValueError(f"--{name}: not for the plot {options.plot}")
    if form in tables:
        write_table(options, output)
        return
    mpl = matplotlib_for_files()
    from tiltpad.draw import bearing, layout, plots

    with ExitStack() as stack, mpl.style.context(plots.STYLE):
        if options.plot == MOVIE:
            run = stack.enter_context(read(one_file(options)))
            bearing.movie(one_bearing(run, options), output, options.last)
            tell_remarks([run])
            return
        make = scheme if options.plot in (BEARING, MACHINE) else picture
        figure, told = make(options, stack)
        stack.callback(plots.plt.close, figure)
        content = io.BytesIO()
        layout.write(figure, content, form)
        writing.write(output, content.getbuffer())
        tell_remarks(told)


def picture(options: argparse.Namespace, stack: ExitStack) -> tuple[Any, list[Run | Study]]:
    """Reads results and studies and draws them; gives those whose remarks are told, too."""
    from tiltpad.draw import figures, layout

    of_study = options.plot in (STUDY, *SAMPLES)
    either = options.plot in (BRANCH, BASIN, *OF_EITHER)
    opened: Callable[[str], Run | Study] = read_study if of_study else read_either if either else read
    sources: list[Any] = [stack.enter_context(opened(path)) for path in options.files]
    runs: list[Any] = [each for source in sources for each in bearings_of(source, options)]
    if options.pad is not None and not (either or of_study):
        layout.shown_pads([run for run in runs if isinstance(run, Run)], options.pad)
    own = (name for name, plots_with in OWN_OPTIONS.items() if options.plot in plots_with)
    more = {name: getattr(options, name) for name in own if getattr(options, name) is not None}
    if options.plot in OWN_OPTIONS["where"]:
        more |= {"where": kept(options)}
    if options.plot in OF_STATIONS:
        more.pop("station", None)
    if options.plot == RESPONSE and options.station is not None:
        if len(options.station) > 1:
            raise ValueError("--station: the response is that of one station")
        more["station"] = options.station[0]
    if options.plot == STUDY:
        return figures.study(runs, pad=options.pad, **more), []
    return figures.FIGURES[options.plot](runs, options.last, options.pad, **more), sources


def bearings_of(source: Run | Study, options: argparse.Namespace) -> list[Run | Study]:
    """What is drawn of a file: of a machine the bearing that --bearing names, or all of them."""
    if options.bearing is not None:
        if isinstance(source, Study) and options.bearing not in source.bearings:
            known = ", ".join(source.bearings) or "it is a study of one bearing"
            raise ValueError(f"{source.path}: no bearing {options.bearing}: {known}")
        return [source.bearings[options.bearing]]
    if isinstance(source, Run) and source.is_machine:
        if options.plot in OF_STATIONS and options.station is not None:
            return [Station(source, number) for number in options.station]
        if not source.bearings:
            check_without_films(source, options.plot)
    of_shaft = options.plot == "stability" or (options.plot == RESPONSE and options.station is not None)
    if isinstance(source, Study) and options.plot in OF_FILMS:
        return [one_bearing(source, options)]
    if isinstance(source, Study) or not source.bearings or options.plot in OF_MACHINES or of_shaft:
        return [source]
    if options.plot == "temperatures" and source.is_branch:
        return [one_bearing(source, options)]
    if options.plot in OF_WHOLE:
        return [source.bearings.whole()]
    return list(source.bearings.values())


def check_without_films(run: Run, plot: str) -> None:
    """Raises NotInRunError for a plot of films of a machine without any, with those that it has."""
    none = f"{run.path}: {plot}: none of its bearings has a film"
    if plot in OF_STATIONS:
        there = run.length("station")
        raise NotInRunError(f"{none}; choose stations of its shaft by --station (1 to {there})")
    if plot in OF_FILMS:
        raise NotInRunError(f"{none}; of its shaft there are {', '.join((*OF_MACHINES, *OF_STATIONS))}")


def one_bearing(source: Run | Study, options: argparse.Namespace) -> Any:
    """The run or study of one bearing, or of the bearing of a machine that --bearing names."""
    if options.bearing is not None:
        return bearings_of(source, options)[0]
    if isinstance(source, Run) and source.is_machine and not source.bearings:
        check_without_films(source, options.plot)
    if source.bearings:
        known = f"of one bearing: its bearings are {', '.join(source.bearings)}"
        raise ValueError(f"{source.path}: {options.plot}: {known}; choose by --bearing")
    return source


def write_table(options: argparse.Namespace, output: Path) -> None:
    """Reads a result or a study and writes its coefficients or critical speeds as a table."""
    if len(options.files) > 1 or options.over is not None:
        raise ValueError(f"{output}: a table is of one file, and over all its parameters")
    if options.station is not None:
        raise ValueError("--station: for the picture, the table has all stations")
    where = kept(options) or None
    with read_either(options.files[0]) as source:
        if options.plot == RESPONSE:
            of = source if options.bearing is None else bearings_of(source, options)[0]
            found = critical_speeds(of, where, options.pivot, options.operating)
            write_critical_speeds(found, output)
        else:
            write_coefficients(one_bearing(source, options), output, pivot=options.pivot, where=where)
        tell_remarks([source])


def scheme(options: argparse.Namespace, stack: ExitStack) -> tuple[Any, list[Run | Study]]:
    """Draws the bearing or the machine of a case or a result."""
    from tiltpad.draw import bearing, machines

    path, whole = one_file(options), options.plot == MACHINE
    case: Any
    if path.suffix == ".nml":
        case = resolved(path, None if whole else options.bearing)
    else:
        found = stack.enter_context(read(path))
        case = found if whole else one_bearing(found, options)
    return machines.machine(case) if whole else bearing.bearing(case), []


def one_file(options: argparse.Namespace) -> Path:
    if len(options.files) > 1:
        raise ValueError(f"{options.plot}: one file")
    return Path(options.files[0])


def kept(options: argparse.Namespace) -> dict[str, str]:
    """The values of parameters that --where asks for."""
    where = dict(options.where or ())
    if len(where) < len(options.where or ()):
        raise ValueError("--where: one value of each parameter")
    return where


def write_report(path: str, output: Path, operating: tuple[float, float] | None = None) -> None:
    """Reads the run and writes the page about it."""
    needs_suffix(output, ("html", "htm"))
    matplotlib_for_files()
    from tiltpad.draw.report import report
    from tiltpad.draw.study_report import study_report

    with read_either(path) as found:
        if operating is not None and not isinstance(found, Study):
            raise ValueError("--operating: for the critical speeds of a study")
        page = study_report(found, operating) if isinstance(found, Study) else report(found)
        writing.write(output, page)
        tell_remarks([found])


def write_lateral_report(case: str, output: Path) -> None:
    """Runs the lateral analysis of a case and writes the page about it, and each of its tables beside it."""
    needs_suffix(output, ("html", "htm"))
    matplotlib_for_files()
    from tiltpad.draw.lateral_report import lateral_report
    from tiltpad.lateral_runs import lateral

    page, tables = lateral_report(lateral(case))
    for each in tables:
        writing.write_csv(output.with_name(f"{output.stem}-{each.name}.csv"), [each.head, *each.rows])
    writing.write(output, page)


def needs_suffix(output: Path, allowed: Sequence[str]) -> str:
    """The suffix of a file's name in small letters, if it is allowed and the folder is there."""
    if not output.parent.is_dir():
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(output))
    suffix = output.suffix.lower().removeprefix(".")
    if suffix not in allowed:
        *others, last = (f".{each}" for each in allowed)
        raise ValueError(f"{output}: the name must end in {', '.join(others)} or {last}")
    return suffix


def matplotlib_for_files() -> Any:
    """matplotlib without a display; loaded only when a picture is drawn, as that takes a second."""
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    import matplotlib as mpl

    from tiltpad.draw.quick import quicken

    mpl.use("agg")
    quicken()
    return mpl


def tell_error(command: str, message: str) -> None:
    print(f"{command}: {message}", file=sys.stderr)


def complain(command: str, message: object, status: int) -> int:
    tell_error(command, f"error: {message}")
    return status


def parser_of(command: str, description: str, wrong: str, output: tuple[str, str], **more: Any) -> Parser:
    """The parser of a command with its `output`, name and default; `wrong` is what else has the status 1."""
    ends = f"exit status: 0 done; 1 usage{wrong}; 3 a file cannot be read or written"
    parser = Parser(prog=command, description=description, epilog=ends, **more)
    parser.add_argument("-o", "--output", metavar=output[0], help=output[1])
    return parser


def report_parser() -> Parser:
    parser = parser_of(
        "tiltpad-report",
        "Writes one HTML page about a result or study of tiltpad: key figures, pictures, input; or runs the "
        "lateral analysis of a machine after API 617 and writes its report, with each table as .csv, too.",
        ", or a wrong case",
        ("HTML", "default: FILE's name with .html (--lateral: -lateral.html), in this folder"),
    )
    parser.add_argument(
        "file", metavar="FILE", help="result file or study (.h5); with --lateral a case (.nml)"
    )
    lateral = "the lateral analysis of a case with groups &impeller and &lateral"
    parser.add_argument("--lateral", action="store_true", help=lateral)
    parser.add_argument("--operating", type=speeds, metavar="RPM", help=OPERATING)
    return parser


def collect_parser() -> Parser:
    parser = parser_of(
        "tiltpad-collect",
        "Puts the results of many runs, such as the runs of a study, into one file: their "
        "parameters, orbits, films, friction, Poincare points, cost, and links to the runs.",
        ", or runs of two studies",
        ("STUDY", "default: the folder's name with .h5, in this folder"),
    )
    parser.add_argument("paths", nargs="+", metavar="FOLDER|FILE", help="folder of results, or result files")
    return parser


def plot_parser() -> Parser:
    plots = "\n".join(f"  {name:<14}{meaning}" for name, meaning in PLOTS.items())
    stations = f"stations, response, {', '.join(OF_STATIONS)}: those of the shaft that are shown (1, 2, ...)"
    formats = ".png, .pdf or .svg (movie: .gif or .mp4)"
    parser = parser_of(
        "tiltpad-plot",
        f"Draws result files of tiltpad, several in one picture.\n\nplots:\n{plots}",
        ", or no such data in the run",
        ("PICTURE", f"{formats}; default: FILE's name with -PLOT.png, in this folder"),
        usage="tiltpad-plot PLOT FILE... [options]",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("plot", type=plot_name, metavar="PLOT", help="one of the plots above")
    parser.add_argument("files", nargs="+", metavar="FILE", help="result files (.h5)")
    options: Any = (
        ("--last", positive, "N", "shows the last N shaft revolutions of the run"),
        ("--pad", int, "K", "shows this pad only (1, 2, ...)"),
        ("--time", float, "T", "time of the film in s; the nearest sample is taken"),
        ("--pivot", str, "NAME", "coefficients and modes of pivots free, stuck or locked"),
        ("--operating", speeds, "RPM", OPERATING),
        ("--orders", positive, "N", "spectrum, waterfall: up to N times the shaft speed"),
        ("--scale", str, ("linear", "log"), "orders: of the amplitudes (linear)"),
        ("--by", str, ("frequency", "order"), "waterfall: vertical axis (frequency)"),
        ("--decades", positive, "N", "waterfall: how far down the colours reach (3)"),
        ("--bearing", str, "NAME", "shows this bearing of a machine only; without it all that go together"),
        ("--station", station_numbers, "K,...", stations),
    )
    for name, kind, values, text in options:
        taken: dict[str, Any] = {"metavar" if isinstance(values, str) else "choices": values}
        parser.add_argument(name, type=kind, help=text, **taken)
    study = parser.add_argument_group("options for studies")
    shown = "result to draw (orbit_size, max_pressure, steps, ...)"
    study.add_argument("--show", metavar="RESULT", help=shown)
    study.add_argument("--over", metavar="PARAMETER", help="parameter of the axis (speed_rpm, ...)")
    study.add_argument("--as", dest="kind", choices=("lines", "map", "bifurcation", "points"))
    kept = "takes only the runs with this value; may be repeated"
    study.add_argument("--where", action="append", type=assignment, metavar="PARAMETER=VALUE", help=kept)
    return parser


def speeds(text: str) -> tuple[float, float]:
    """Operating speeds: "4000", or the lowest and the highest, "3600:4200"."""
    with suppress(ValueError):
        return operating_range([float(each) for each in text.split(":")])
    must = "must be a speed in rpm, or the lowest and the highest, LOW:HIGH"
    raise argparse.ArgumentTypeError(f"{text}: {must}")


def plot_name(text: str) -> str:
    if text in PLOTS:
        return text
    if Path(text).exists():
        belongs = f"where the plot's name belongs: tiltpad-plot PLOT {text}"
        raise argparse.ArgumentTypeError(f"{text}: a file, {belongs}")
    raise argparse.ArgumentTypeError(f"{text}: no plot{meant(text, PLOTS)}: {', '.join(PLOTS)}")


def assignment(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not (name and equals and value):
        raise argparse.ArgumentTypeError(f"{text}: must be PARAMETER=VALUE")
    return name.strip(), value.strip()


def station_numbers(text: str) -> list[int]:
    with suppress(ValueError):
        return [int(each) for each in text.split(",")]
    raise argparse.ArgumentTypeError(f"{text}: must be numbers of stations, as 2,7")


def positive(text: str) -> float:
    with suppress(ValueError):
        if 0 < float(text) < float("inf"):
            return float(text)
    raise argparse.ArgumentTypeError(f"{text}: must be a positive number")


if __name__ == "__main__":
    sys.exit(main())
