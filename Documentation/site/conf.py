# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The site of the documentation, for Sphinx (Utilities/docs.sh).

The pages are plain Markdown that any forge shows; all that only the site needs is here.
"""

import glob
import os

from docutils import nodes

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")

project = "vtkLightTransport"
author = "the vtkLightTransport authors"
copyright = author  # Sphinx's name
extensions = ["myst_parser"]
root_doc = "README"
include_patterns = ["*.md", "Data/*.md", "Documentation/**.md"]
exclude_patterns = ["build*", "demo"]
myst_heading_anchors = 3
html_theme = "furo"
html_title = project
html_static_path = ["static"]
html_css_files = ["site.css"]
templates_path = ["templates"]
# The address without a page leads to the first one.
html_additional_pages = {"index": "redirect.html"}
# Furo's own, and below its tree what Doxygen makes.
html_sidebars = {"**": [
    "sidebar/brand.html", "sidebar/search.html", "sidebar/scroll-start.html",
    "sidebar/navigation.html", "classes.html", "sidebar/scroll-end.html"]}
html_show_copyright = False
# Names of arrays stand in quotes and are copied from here.
smartquotes = False
html_copy_source = False

# The page of each public class in what Doxygen makes beside the pages.
CLASSES = {
    os.path.basename(header)[:-2]
    for folder in ("Filters/Meshing", "Filters/Transport", "Rendering", "IO")
    for header in glob.glob(os.path.join(ROOT, folder, "vtk*.h"))}

START = ["paraview", "python", "shell", "cpp", "gallery", "platforms"]
GUIDE = ["install", "arrays", "patches", "sheets", "view-factors", "many-patches", "heat",
         "scattering", "models", "opengl", "openexr", "report", "demonstration"]
DESIGN = ["scene", "links", "sampled-links", "view-factors", "clusters", "radiosity",
          "scattering", "meshing", "opengl", "build"]
# What the side bar holds: captions and pages below a page.
CONTENTS = {
    "README": (
        ("Use", ["Documentation/start/index", "Documentation/guide/index", "Documentation/errors",
                 "Documentation/limits", "Documentation/measurements", "Data/README"]),
        ("Inside", ["Documentation/glossary", "Documentation/design/index", "CONTRIBUTING",
                    "CHANGELOG"])),
    "Documentation/start/index": ((None, ["Documentation/start/" + page for page in START]),),
    "Documentation/guide/index": ((None, ["Documentation/guide/" + page for page in GUIDE]),),
    "Documentation/design/index": ((None, ["Documentation/design/" + page for page in DESIGN]),),
}


def add_contents(_app, page, source):
    for caption, pages in CONTENTS.get(page, ()):
        options = ":hidden:\n" + (f":caption: {caption}\n" if caption else "")
        entries = "\n".join("/" + entry for entry in pages)
        source[0] += f"\n\n```{{toctree}}\n{options}\n{entries}\n```\n"


def link_classes(_app, document, page):
    """Names of public classes that stand in a page as code lead to what Doxygen says of them."""
    up = "../" * page.count("/")
    for literal in list(document.findall(nodes.literal)):
        name = literal.astext()
        if name in CLASSES and not isinstance(literal.parent, nodes.reference):
            link = nodes.reference("", "", refuri=f"{up}api/class{name}.html", internal=False)
            literal.replace_self(link)
            link += literal


def setup(app):
    app.connect("source-read", add_contents)
    app.connect("doctree-resolved", link_classes)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
