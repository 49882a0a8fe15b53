"""What each pad does at the end of a run, by its file: it carries no load, flutters or rubs."""

from tiltpad.files.read import Run

#: Words for a picture, and the figures of the pads that tell them.
MARKS = {"no load": "pad_unloaded", "flutters": "pad_flutters", "rubs": "pad_rubbing"}


def marks(run: Run) -> dict[int, str]:
    """A few words on each pad (1, 2, ...) that carries no load, flutters or rubs; none if not known."""
    figures = {word: f"summary/{name}" for word, name in MARKS.items()}
    known = {word: run[name] > 0 for word, name in figures.items() if name in run}
    found = {k + 1: "\n".join(word for word in known if known[word][k]) for k in range(run.pads)}
    return {pad: words for pad, words in found.items() if words}
