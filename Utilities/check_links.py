#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the links of all Markdown pages: what they name must be there, files and headings.

Prints what is broken and exits with 1 when anything is. Links to other sites are not followed.
"""

import os
import re
import sys
from urllib.parse import unquote

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LEFT_OUT = re.compile(r"\.git|build.*|demo")
LINK = re.compile(r'\]\(<?([^)<>\s]+)[^)]*\)|^\[[^\]]+\]:\s*(\S+)|\b(?:src|href)="([^"]+)"', re.M)


def find_pages():
    for folder, folders, names in os.walk(ROOT):
        folders[:] = sorted(name for name in folders if not LEFT_OUT.fullmatch(name))
        yield from (os.path.join(folder, name) for name in sorted(names) if name.endswith(".md"))


def read(page):
    """The text of a page; of blocks of code only the line breaks are left."""
    with open(page, encoding="utf-8") as file:
        return re.sub(r"^( *)```.*?^\1```", lambda code: "\n" * code[0].count("\n"), file.read(),
                      flags=re.M | re.S)


def find_anchors(page):
    """The names by which forges, and MyST, know the headings of a page."""
    titles = [title.strip().lower() for title in re.findall(r"^#+ +(.*)", read(page), re.M)]
    return {re.sub(r"[^\w\- ]", "", title).replace(" ", "-") for title in titles}


def find_problem(page, link):
    target, _, anchor = unquote(link).partition("#")
    path = os.path.normpath(os.path.join(os.path.dirname(page), target)) if target else page
    if not os.path.exists(path):
        return "there is no such file"
    if anchor and path.endswith(".md") and anchor not in find_anchors(path):
        return "there is no such heading"
    return None


broken = 0
for page in find_pages():
    text = re.sub(r"`[^`\n]*`", "", read(page))
    for match in LINK.finditer(text):
        link = next(group for group in match.groups() if group)
        problem = None if re.match(r"[a-z][a-z0-9+.-]*:", link) else find_problem(page, link)
        if problem:
            broken += 1
            line = text.count("\n", 0, match.start()) + 1
            print(f"{os.path.relpath(page, ROOT)}:{line}: {link}: {problem}")
sys.exit(1 if broken else 0)
