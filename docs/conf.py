"""The manual: how Sphinx reads the pages of docs/. scripts/build-manual runs it on a copy in build/manual/source/."""

import os
from pathlib import Path

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml

ROOT = Path(os.environ["COAGULA_ROOT"])
SOURCE = Path(os.environ["COAGULA_MANUAL"]) / "source"

project = "coagula"
author = "the authors of coagula"
version = os.environ["COAGULA_VERSION"]
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
root_doc = "docs/index"
smartquotes = False
highlight_language = "none"
suppress_warnings = ["misc.highlighting_failure"]  # what a program prints need not be a language

html_theme = "furo"
html_title = f"coagula {version}"
html_static_path = ["static", "/usr/share/fonts/truetype/dejavu/DejaVuMathTeXGyre.ttf"]  # fonts-dejavu-extra
html_css_files = ["manual.css"]
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_last_updated_fmt = None

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4

breathe_projects = {library.name: str(library / "xml") for library in (SOURCE.parent / "doxygen").iterdir()}
breathe_default_members = ("members",)

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings name the types
napoleon_google_docstring = False


def link_into_repository(app, env, node, contnode):
    """A link to a file or folder of the repository that is no page of the manual stands as its path, without a link."""
    target = node.get("reftarget", "").split("#")[0]
    page = Path(env.doc2path(node.get("refdoc", root_doc), base=False))
    there = (ROOT / page.parent / target).resolve()
    if target and ROOT in there.parents and there.exists():
        return nodes.inline("", "", *contnode.children) if contnode.children else contnode
    return None


def show_inline(translator, node):
    translator.body.append(tex2mathml(node.astext(), inline=True))
    raise nodes.SkipNode


def show_displayed(translator, node):
    translator.body.append(f'<div class="math">{tex2mathml(node.astext(), inline=False)}</div>')
    raise nodes.SkipNode


def setup(app):
    app.connect("missing-reference", link_into_repository)
    app.add_html_math_renderer("mathml", inline_renderers=(show_inline, None), block_renderers=(show_displayed, None))


html_math_renderer = "mathml"  # browsers draw it themselves: no script, no network
