"""Tables of the page."""

from collections.abc import Iterable, Sequence


def table(head: Sequence, rows: Iterable[Sequence]) -> str:
    """A Markdown table."""
    lines = (head, ["---"] * len(head), *rows)
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def digits(value: float, count: int = 3) -> str:
    """A number with this number of digits, without an exponent where it is of common size."""
    if value == 0 or 1e-3 <= abs(value) < 1e4:
        text = f"{value:#.{count}g}"
        return text.rstrip(".")
    return f"{value:.{count - 1}e}"
