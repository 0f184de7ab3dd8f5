# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""A page from top to bottom: paragraphs, tables, figures. HTML, well-formed as XML too."""

import os
from html import escape

from vtklighttransport.replacement import replace_file

STYLE = """
body { font: 16px/1.5 sans-serif; color: #222; max-width: 60em; margin: 0 auto; }
body { padding: 0 1em 2em; }
h1, h2 { line-height: 1.2; }
img { max-width: 100%; height: auto; }
figure { margin: 1em 0; }
figcaption { color: #555; }
dt { font-weight: bold; }
dd { margin: 0 0 0.5em; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 14px; white-space: nowrap; }
th, td { padding: 0.15em 0.6em; border-bottom: 1px solid #ddd; text-align: right; }
th.text, td.text { text-align: left; }
"""


class Page:
    """Where a figure cannot be drawn, `note` is told why, and no further one is tried."""

    def __init__(self, title, folder, messages, note):
        self.title = title
        self.folder = folder
        self.messages = messages
        self.note = note
        self.parts = []
        self.draws_figures = True

    def leave_out_figures(self, reason):
        self.draws_figures = False
        self.note("Plots and pictures: " + reason)

    def add(self, text):
        self.parts.append(text)

    def add_heading(self, text):
        self.add(f"<h2>{escape(text)}</h2>")

    def add_paragraph(self, text):
        self.add(f"<p>{escape(text)}</p>")

    def add_warning(self, text):
        self.add(f"<p><strong>{escape(text)}</strong></p>")

    def add_terms(self, terms):
        self.add("<dl>" + "".join(f"<dt>{name}</dt><dd>{escape(text)}</dd>"
                                  for name, text in terms.items()) + "</dl>")

    def add_list(self, texts):
        self.add("<ul>" + "".join(f"<li>{escape(text)}</li>" for text in texts) + "</ul>")

    def add_rows(self, names, rows):
        """A table: headings, and rows of (text, whether it is a number)."""
        def make_cells(tag, cells):
            return "".join(f"<{tag}>{escape(text)}</{tag}>" if number else
                           f'<{tag} class="text">{escape(text)}</{tag}>' for text, number in cells)
        self.add('<div class="wide"><table>\n<thead><tr>' + make_cells("th", names) +
                 "</tr></thead>\n<tbody>")
        for row in rows:
            self.add("<tr>" + make_cells("td", row) + "</tr>")
        self.add("</tbody></table></div>")

    def add_figure(self, name, caption, draw):
        """A picture that `draw(file)` makes."""
        if not self.draws_figures:
            return
        file = os.path.join(self.folder, name)
        draw(file)
        if self.messages.errors:
            self.leave_out_figures(self.messages.take())
            # Whatever there is, it is blank, or of another run.
            if os.path.exists(file):
                os.remove(file)
            return
        self.add(f'<figure><img src="{name}" alt="{escape(caption)}"/>'
                 f"<figcaption>{escape(caption)}</figcaption></figure>")

    def write(self, file):
        body = "\n".join(self.parts)
        text = (
            '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8"/>\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1"/>\n'
            f"<title>{escape(self.title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n"
            f"<h1>{escape(self.title)}</h1>\n{body}\n</body>\n</html>\n")
        replace_file(os.path.join(self.folder, file), text.encode())
