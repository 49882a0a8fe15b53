"""Drawing by the commands in less time, with the same pictures.

matplotlib makes signatures and words of help for each class as it loads, finds the ticks of an axis, their
boxes and the box of a text anew wherever a layout asks for them, ten times for a picture, reads the same
formula for each picture, and copies the marks of each tick as deep as they go: most of what a report costs.
A command needs no help, and between two moves of its axes a picture gets the same ticks and boxes again. What
a version of matplotlib does not have under these names stays as it is.
"""

import sys
from collections.abc import Callable
from functools import wraps
from typing import Any

#: Names that are replaced: of matplotlib.artist, its class Artist, texts, axes, marks, figures, and of PIL.
HELP, SIGNATURE, BOX, TICKS, TICK_BOXES, FORMULAS, MARK, DRAW, FORMATS = (
    "kwdoc",
    "_update_set_signature_and_docstring",
    "_get_layout",
    "_update_ticks",
    "_get_ticklabel_bboxes",
    "TextToPath",
    "_set_marker",
    "draw",
    "preinit",
)


def quicken() -> None:
    """Replaces these; before anything else of matplotlib is loaded, and once."""
    from matplotlib import artist

    if "matplotlib.text" not in sys.modules:
        replace(artist.Artist, SIGNATURE, lambda _: classmethod(lambda cls: None))
        replace(artist, HELP, lambda _: lambda cls: "")
    from matplotlib import text, textpath
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure
    from matplotlib.markers import MarkerStyle
    from PIL import Image

    if not hasattr(getattr(text.Text, BOX, None), "__wrapped__"):
        replace(text.Text, BOX, kept_boxes)
        replace(text, FORMULAS, lambda _: lambda: textpath.text_to_path)
        drawings: list[object] = []
        replace(Axis, TICKS, lambda find: kept(find, drawings))
        replace(Axis, TICK_BOXES, lambda find: kept(find, drawings))
        replace(Figure, DRAW, lambda draw: counted(draw, drawings))
        replace(MarkerStyle, MARK, lambda take: shallow(take, MarkerStyle))
        replace(Image, FORMATS, lambda _: png_alone)


def replace(owner: Any, name: str, make: Callable[[Any], Any]) -> None:
    """Puts in the place of an attribute, where it is there, what is made of it."""
    if hasattr(owner, name):
        setattr(owner, name, make(getattr(owner, name)))


def kept_boxes(find: Callable[..., Any]) -> Callable[..., Any]:
    """The box of a text, found anew where the text or its look has changed."""

    @wraps(find)
    def box(text: Any, renderer: Any) -> Any:
        if text.get_wrap() or text.get_transform_rotates_text():
            return find(text, renderer)
        place = (text.get_rotation(), text.get_rotation_mode(), text.get_ha(), text.get_va())
        look = (text.get_usetex(), text.get_parse_math(), vars(text).get("_linespacing"))
        lines = vars(text).get("_multialignment")
        of = (type(renderer), text.get_figure(root=True).dpi, hash(text.get_fontproperties()))
        key = (text.get_text(), *place, *look, lines, *of)
        if vars(text).get("kept_box", (None,))[0] != key:
            vars(text)["kept_box"] = (key, find(text, renderer))
        return vars(text)["kept_box"][1]

    return box


def kept(find: Callable[..., Any], drawings: list[object]) -> Callable[..., Any]:
    """What an axis in a plane finds, once in a drawing as long as the axes stay where they are."""
    name = f"kept{find.__name__}"

    @wraps(find)
    def found(axis: Any, *of: Any) -> Any:
        if not drawings or axis.axes.name == "3d":
            return find(axis, *of)
        key = (drawings[-1], *axis.axes.bbox.bounds, *axis.get_view_interval(), *map(id, of))
        if vars(axis).get(name, (None,))[0] != key:
            vars(axis)[name] = (key, find(axis, *of), of)  # an id is that of one thing as long as this lives
        return vars(axis)[name][1]

    return found


def counted(draw: Callable[..., Any], drawings: list[object]) -> Callable[..., Any]:
    """The drawing of a figure with its layout, which `drawings` has while it lasts."""

    @wraps(draw)
    def draw_figure(*arguments: Any) -> Any:
        drawings.append(object())
        try:
            return draw(*arguments)
        finally:
            drawings.pop()

    return draw_figure


def shallow(take: Callable[..., Any], kind: type) -> Callable[..., Any]:
    """Takes a mark from another one with the same paths, which nothing changes."""

    @wraps(take)
    def take_mark(mark: Any, other: Any) -> None:
        if not isinstance(other, kind):
            take(mark, other)
            return
        vars(mark).update(vars(other))
        if method := vars(other).get("_marker_function"):
            vars(mark)["_marker_function"] = getattr(mark, method.__name__)

    return take_mark


def png_alone() -> None:
    """Loads what writes a PNG; PIL loads all its other formats where one is asked for."""
    from PIL import PngImagePlugin  # noqa: F401
