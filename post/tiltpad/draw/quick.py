"""Drawing by the commands in less time, with the same pictures.

matplotlib makes signatures and words of help for each class as it loads, and finds the ticks of an axis and
the box of a text anew wherever a layout asks for them, ten times for a picture: most of what a report costs.
A command needs no help, and between two moves of its axes a layout gets the same ticks and boxes again. What
a version of matplotlib does not have under these names stays as it is.
"""

import sys
from collections.abc import Callable
from functools import wraps
from typing import Any

#: Names that are replaced: of matplotlib.artist, its class Artist, texts, axes, and the engine of layouts.
HELP, SIGNATURE, BOX, TICKS, LAYOUT = (
    "kwdoc",
    "_update_set_signature_and_docstring",
    "_get_layout",
    "_update_ticks",
    "execute",
)


def quicken() -> None:
    """Replaces these; before anything else of matplotlib is loaded, and once."""
    from matplotlib import artist

    if "matplotlib.text" not in sys.modules:
        replace(artist.Artist, SIGNATURE, lambda _: classmethod(lambda cls: None))
        replace(artist, HELP, lambda _: lambda cls: "")
    from matplotlib.axis import Axis
    from matplotlib.layout_engine import ConstrainedLayoutEngine
    from matplotlib.text import Text

    if not hasattr(getattr(Text, BOX, None), "__wrapped__"):
        replace(Text, BOX, kept_boxes)
        layouts: list[object] = []
        replace(Axis, TICKS, lambda find: kept_ticks(find, layouts))
        replace(ConstrainedLayoutEngine, LAYOUT, lambda execute: counted(execute, layouts))


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


def kept_ticks(find: Callable[..., Any], layouts: list[object]) -> Callable[..., Any]:
    """The ticks of an axis in a plane, found once in a layout as long as the axes stay where they are."""

    @wraps(find)
    def ticks(axis: Any) -> Any:
        if not layouts or axis.axes.name == "3d":
            return find(axis)
        key = (layouts[-1], *axis.axes.bbox.bounds, *axis.get_view_interval())
        if vars(axis).get("kept_ticks", (None,))[0] != key:
            vars(axis)["kept_ticks"] = (key, find(axis))
        return vars(axis)["kept_ticks"][1]

    return ticks


def counted(execute: Callable[..., Any], layouts: list[object]) -> Callable[..., Any]:
    """A layout, which `layouts` has while it is made."""

    @wraps(execute)
    def execute_layout(*arguments: Any) -> Any:
        layouts.append(object())
        try:
            return execute(*arguments)
        finally:
            layouts.pop()

    return execute_layout
