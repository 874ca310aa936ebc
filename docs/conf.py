"""The site of this documentation, which `make docs` builds."""

import re
import sys
from importlib.metadata import version as version_of
from inspect import isclass
from pathlib import Path

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from numpydoc.xref import DEFAULT_LINKS
from sphinx.util.logging import getLogger

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent / "tests")]

from course_notebooks import offer, sheets, write_notebooks  # noqa: E402
from reference_pages import write_reference  # noqa: E402

from public_names import public_names  # noqa: E402

project = "roughcontact"
author = "The roughcontact developers"
project_copyright = author
version = release = version_of(project)

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "numpydoc",
    "sphinx_gallery.gen_gallery",
    "sphinx_reredirects",
]
smartquotes = False  # options begin with two dashes
myst_heading_anchors = 3
myst_enable_extensions = ["dollarmath"]

autodoc_typehints = "none"  # docstrings name the types, with shapes and units
numpydoc_show_class_members = False
numpydoc_xref_param_type = True
numpydoc_xref_ignore = "all"  # but for classes of this package: sites of others are not asked
DEFAULT_LINKS.clear()
numpydoc_xref_aliases = {name.value.__name__: name.path for name in public_names() if isclass(name.value)}
default_role = "py:obj"
nitpicky = True
nitpick_ignore_regex = [("py:obj", r"(xarray|dask_jobqueue)\..*")]

sphinx_gallery_conf = {
    "examples_dirs": "../examples/gallery",
    "gallery_dirs": "gallery",
    "filename_pattern": "/",  # all of them run
    "image_scrapers": ("two_themes.scrape",),
    "within_subsection_order": "FileNameSortKey",
    "abort_on_example_error": True,
    "download_all_examples": False,
    "show_signature": False,
    "write_computation_times": False,
}

# For readers in a repository: here the page that is made of the scripts stands in its place.
exclude_patterns = ["gallery.md"]

html_theme = "pydata_sphinx_theme"
html_title = project
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_sourcelink = html_copy_source = False
html_math_renderer = "mathml"
html_search_scorer = str(HERE / "search_order.js")
html_theme_options = {"navigation_with_keys": False, "header_links_before_dropdown": 8, "show_toc_level": 2}
html_context = {"default_mode": "auto"}  # light or dark, as the reader has it

# Pages whose list of links is the list of pages below them.
PARTS = {"index"} | {path.relative_to(HERE).with_suffix("").as_posix() for path in HERE.glob("*/index.md")}
# What a browser fetches when it opens a page, from elsewhere.
FETCHED = re.compile(r"""<(?!a\b)[^>]*\b(?:src|href)=["'](?:https?:)?//[^>]*>""")


def setup(app):
    """Add what Sphinx does not bring."""
    app.connect("config-inited", lambda app, config: write_reference(HERE / "api"))
    app.connect("config-inited", lambda app, config: copy_project(HERE / "project"))
    app.connect("config-inited", redirect)
    app.connect("source-read", list_to_tree)
    app.connect("source-read", offer_notebook)
    app.connect("missing-reference", link_to_name)
    app.connect("build-finished", write_course)
    app.connect("build-finished", require_local)
    app.add_html_math_renderer("mathml", (formula, None), (formula, None))


def copy_project(folder):
    """Copy the pages that stand above this folder, as those of a repository do, to where Sphinx finds them."""
    folder.mkdir(exist_ok=True)
    for path in HERE.parent.glob("*.md"):
        text = path.read_text(encoding="utf-8").replace("](docs/", "](../")
        if path.name != "README.md":
            (folder / path.name).write_text(text, encoding="utf-8")


def redirect(app, config):
    """Redirect the addresses that pages had before they stood in folders by kind."""
    for folder in ("how-to", "concepts", "reference", "evidence", "project"):
        for name in (page.stem for page in (HERE / folder).glob("[a-z]*.md")):
            config.redirects[folder if name == "index" else name] = f"{folder}/{name}.html"
    for page in [*(HERE / "api").glob("*.md"), *(HERE / "api").glob("*.rst")]:
        config.redirects[f"reference/{page.stem}"] = f"../api/{page.stem}.html"


def list_to_tree(app, name, text):
    """Make a tree of the pages that a part lists, for the menus: readers of the Markdown see the list alone."""
    text[0] = re.sub(r"\]\((?:\.\./)+([A-Z_]+\.md)\)", r"](/project/\1)", text[0])
    text[0] = text[0].replace("gallery.md)", "gallery/index.rst)")
    if name in PARTS:
        pages = re.findall(r"^\* \[[^]]*\]\(([^):#]+)\.(?:md|rst)\)", text[0], re.MULTILINE)
        text[0] += "\n".join(["\n\n```{toctree}\n:hidden:", *pages, "```\n"])


def offer_notebook(app, name, text):
    """Link the notebooks of a sheet of the course below its title."""
    if HERE / f"{name}.md" in sheets(HERE / "course"):
        text[0] = text[0].replace("\n\n", offer(Path(name).name), 1)


def write_course(app, error):
    """Write the notebooks of the course, each beside its page."""
    if not error:
        write_notebooks(HERE / "course", Path(app.outdir) / "course")


def link_to_name(app, env, node, text):
    """Link a name that stands on another page; a word in lower case may be a parameter, and stays as it is."""
    if node.get("refdomain") != "py":
        return None
    name, domain = node["reftarget"], env.get_domain("py")
    word = name.islower() and "." not in name
    paths = [path for path, entry in domain.objects.items() if not entry.aliased]
    found = [
        path for path in paths if path == f"{project}.{name}" or (not word and path.endswith(f".{name}"))
    ]
    if len(found) == 1:
        return domain.resolve_xref(env, node["refdoc"], app.builder, "obj", found[0], node, text)
    return text if word else None


def formula(writer, node):
    """Write mathematics as MathML, which browsers show without a script."""
    writer.body.append(tex2mathml(node.astext(), as_block=isinstance(node, nodes.math_block)))
    raise nodes.SkipNode


def require_local(app, error):
    """Warn of a page that is not whole without a network."""
    for page in [] if error else Path(app.outdir).rglob("*.html"):
        for tag in FETCHED.findall(page.read_text(encoding="utf-8")):
            getLogger(__name__).warning("%s asks elsewhere: %s", page.name, tag)
