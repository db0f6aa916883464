"""How Sphinx makes the site. `./dev site` runs it on a copy of docs/ with the generated pages beside (tools/site.py)."""

import json
import os
from pathlib import Path

from docutils import nodes

project = "ursula"
author = "the ursula authors"
project_copyright = "the ursula authors"
extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
root_doc = "index"
exclude_patterns = ["api", "README.md"]
html_theme = "furo"
html_title = "ursula"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_copy_source = False
html_show_copyright = False
html_extra_path = [path for path in ("extra",) if Path(path).is_dir()]
highlight_language = "none"
nitpicky = True
myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence"]
# A heading such as `points = [{ … }, …]` is Markdown, and its slug is GitHub's.
root = Path(os.environ["URSULA_ROOT"])
formulas = json.loads((root / "report/web/bundle/formulas.json").read_text(encoding="utf-8"))


def typeset(app, doctree):
    """Cells that hold a formula of the paper alone show it as the report does: MathML, without a script or a font."""
    for entry in doctree.findall(nodes.entry):
        mathml = formulas.get(entry.astext().strip())
        if mathml and "html" in app.builder.name:
            entry[:] = [nodes.raw("", mathml, format="html")]


def scroll_tables(app, doctree):
    """Wide tables scroll by themselves; the page does not."""
    for table in list(doctree.findall(nodes.table)):
        box = nodes.container(classes=["wide"])
        table.replace_self(box)
        box += table


def setup(app):
    app.connect("doctree-read", typeset)
    app.connect("doctree-read", scroll_tables)
    return {"parallel_read_safe": True}
