"""Results and studies as notebooks show them."""

from html import escape

import h5py

from tiltpad.files.archive import Archive


def html_of(archive: Archive, heading: str) -> str:
    """A heading and a table of the datasets, with shape, unit and meaning; groups can be opened."""
    single, groups = archive.single_and_groups()
    remarks = [f"<p>remark: {escape(each)}</p>" for each in getattr(archive, "remarks", [])]
    parts = [f"<p><b>{escape(heading)}</b></p>", *remarks, table(archive, "", single)]
    for group in groups:
        own = table(archive, group, archive.names(group))
        parts.append(f"<details><summary>{escape(group)}</summary>{own}</details>")
    return "".join(parts)


def table(archive: Archive, group: str, names: list[str]) -> str:
    """The datasets of a group, a row each."""
    rows = ["<tr><th>name</th><th>shape</th><th>unit</th><th>meaning</th></tr>"]
    for name in names:
        path = f"{group}/{name}".lstrip("/")
        found = archive.item(path)
        shape = str(found.shape) if isinstance(found, h5py.Dataset) else ""
        cells = (name, shape, archive.about(path, "units"), archive.about(path, "long_name"))
        rows.append("<tr>" + "".join(f"<td>{escape(each)}</td>" for each in cells) + "</tr>")
    return f"<table>{''.join(rows)}</table>"
