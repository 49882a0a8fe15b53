"""What mkdocs does with the pages of docs, which have no syntax of a site: navigation, notebook, style."""

import json
import re
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

TOP = Path(__file__).resolve().parents[2]


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Navigation: the pages in the tables of the README, for users and for developers."""
    parts = re.findall(
        r"^## (Pages for \w+)\n(.*?)\n\n(?=[^|]|\Z)", (TOP / "README.md").read_text(), re.M | re.S
    )
    config.nav = [{"Home": "README.md"}]
    for title, table in parts:
        pages: list = []
        for row in re.findall(r"^\| (.*\]\(.*) \|", table, re.M):
            cell, _, contents = row.partition(" | ")
            pages += [as_page(target) for _, target in re.findall(r"\[(.*?)\]\((.*?)\)", cell)]
        config.nav.append({title.removeprefix("Pages ").capitalize(): pages})
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """The notebook as a page."""
    cells = json.loads((TOP / "docs/notebook.ipynb").read_text())["cells"]
    text = ["".join(cell["source"]) for cell in cells]
    fenced = [
        f"```python\n{source}\n```" if cell["cell_type"] == "code" else source
        for cell, source in zip(cells, text, strict=True)
    ]
    files.append(File.generated(config, "docs/notebook.md", content="\n\n".join(fenced)))
    return files


def on_page_markdown(markdown: str, page: Page, **_: object) -> str:
    """Links to the notebook lead to its page; home has no neighbours to list; terms are found first."""
    if page.is_homepage:
        page.meta["hide"] = ["navigation"]
    if page.file.src_uri == "docs/terms.md":
        page.meta["search"] = {"boost": 10}
    return markdown.replace("notebook.ipynb)", "notebook.md)")


def as_page(target: str) -> str:
    return target.replace(".ipynb", ".md")
