"""The command tiltpad-plot."""

import argparse
import sys
import warnings
from collections.abc import Sequence
from contextlib import ExitStack, suppress
from pathlib import Path

from tiltpad.library import LibraryError, MissingLibraryError
from tiltpad.read import IncompleteRunWarning, NotInRunError, RunError, read

FORMATS = ("png", "pdf", "svg")
#: Exit status, as the program's own.
INPUT_ERROR, FILE_ERROR = 1, 3

PLOTS = {
    "orbit": "path of the journal in its clearance circle, and enlarged (last revolution)",
    "size": "peak-to-peak of the journal: of one run, over what differs between runs, over speed",
    "poincare": "journal and a pad once a revolution (last 50 revolutions, pad 1)",
    "waveform": "journal, tilt and tilt rate over the last revolutions (5)",
    "spectrum": "amplitudes of the journal, one-sided and full, at constant speed (those in the file)",
    "hysteresis": "friction moment over pad tilt, a panel a pad (last revolution)",
    "friction": "friction coefficient over sliding velocity, a panel a pad (last revolution)",
    "sticking": "tilt rate, bold where the pivot sticks, a panel a pad (last 2 revolutions)",
    "runup": "journal and tilt over the whole run, with the speed",
    "orders": "amplitude and phase of the first orders over the speed of a run-up (with --pad: its tilt too)",
    "waterfall": "amplitudes over speed and order of a run-up (journal, or with --pad its tilt)",
    "pressure": "film pressure over the unrolled pads at one instant (--time; else at the equilibrium)",
}


class Parser(argparse.ArgumentParser):
    """One line and the program's own exit status for a wrong command line."""

    def error(self, message: str) -> None:
        self.exit(complain(f"{message}; see {self.prog} --help", INPUT_ERROR))


def main(arguments: Sequence[str] | None = None) -> int:
    """Draws what the command line asks for; gives the exit status."""
    options = parser().parse_args(arguments)
    output = Path(options.output or f"{Path(options.files[0]).stem}-{options.plot}.png")
    try:
        if output.suffix.lower().removeprefix(".") not in FORMATS:
            raise ValueError(f"{output}: the name must end in .png, .pdf or .svg")
        if options.time is not None and options.plot != "pressure":
            raise ValueError(f"--time: for the plot pressure, not for {options.plot}")
        draw(options, output)
    except (ValueError, NotInRunError) as error:
        return complain(error, INPUT_ERROR)
    except RunError as error:
        return complain(error, FILE_ERROR)
    except LibraryError as error:
        return complain(error, error.status)
    except MissingLibraryError as error:
        return complain(error, FILE_ERROR)
    except OSError as error:
        return complain(f"{output}: cannot be written: {error.strerror or error}", FILE_ERROR)
    except KeyboardInterrupt:
        return complain("stopped", 130)
    except Exception as error:
        return complain(f"please report this fault: {type(error).__name__}: {error}", FILE_ERROR)
    return 0


def draw(options: argparse.Namespace, output: Path) -> None:
    """Reads the runs, draws them and writes the picture."""
    import matplotlib as mpl  # after --help and wrong options, which need not wait for it

    mpl.use("agg")
    from tiltpad import figures, plots

    with ExitStack() as stack:
        caught = stack.enter_context(warnings.catch_warnings(record=True))
        warnings.simplefilter("ignore")
        warnings.simplefilter("always", IncompleteRunWarning)
        runs = [stack.enter_context(read(path)) for path in options.files]
        for warning in caught:
            print(f"tiltpad-plot: warning: {warning.message}", file=sys.stderr)
        stack.enter_context(mpl.style.context(plots.STYLE))
        if options.pad is not None:
            figures.shown_pads(runs, options.pad)
        when = {"time": options.time} if options.plot == "pressure" else {}
        figure = figures.FIGURES[options.plot](runs, options.last, options.pad, **when)
        stack.callback(plots.plt.close, figure)
        figure.savefig(output, format=output.suffix.lower().removeprefix("."))


def complain(message: object, status: int) -> int:
    print(f"tiltpad-plot: error: {message}", file=sys.stderr)
    return status


def parser() -> Parser:
    plots = "\n".join(f"  {name:<12}{meaning}" for name, meaning in PLOTS.items())
    parser = Parser(
        prog="tiltpad-plot",
        usage="tiltpad-plot PLOT FILE... [options]",
        description=f"Draws result files of tiltpad, several laid over each other.\n\nplots:\n{plots}",
        epilog="exit status: 0 done; 1 usage, or no such data in the run; 3 a file cannot be read or written",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("plot", choices=PLOTS, metavar="PLOT", help=" | ".join(PLOTS))
    parser.add_argument("files", nargs="+", metavar="FILE", help="result files (.h5)")
    parser.add_argument(
        "-o",
        "--output",
        metavar="PICTURE",
        help=".png, .pdf or .svg; default: FILE's name with -PLOT.png, here",
    )
    parser.add_argument("--last", type=positive, metavar="N", help="shaft revolutions at the end of the run")
    parser.add_argument("--pad", type=int, metavar="K", help="this pad only (1, 2, ...)")
    parser.add_argument("--time", type=float, metavar="T", help="of the pressure: the sample next to T, s")
    return parser


def positive(text: str) -> float:
    with suppress(ValueError):
        if 0 < float(text) < float("inf"):
            return float(text)
    raise argparse.ArgumentTypeError(f"{text}: must be a positive number")


if __name__ == "__main__":
    sys.exit(main())
