#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the messages of Documentation/errors.md are those of the sources.

What stands for values there (N, X, "X", ...) divides a message into pieces; each piece must be in
the text of some source. Prints what is not, and exits with 1 then.
"""

import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGE = os.path.join(ROOT, "Documentation", "errors.md")
FOLDERS = ("Filters", "IO", "Rendering", "ParaView", "Python/vtklighttransport", "Utilities")
ENDINGS = (".cxx", ".h", ".py", ".sh")
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"|\'((?:[^\'\\\n]|\\.)*)\'')
# A value, what goes with its number or kind, or where the page goes on to another message.
VALUE = re.compile(
    r'"[^"]*"|\b[A-Z](?: x [A-Z])*\b|\b[A-Z]{3,}\b|\b\d+\b|\bGB\b|\b[a-z]*[A-Z]\w*[A-Z]\w*'
    r'|\bpolygons?\b|\b(?:cell|point) array\b|\.\.\.|[/;:,()]|%')


def find_sources():
    for folder in FOLDERS:
        for place, folders, names in os.walk(os.path.join(ROOT, folder)):
            folders[:] = [name for name in folders if name not in ("Testing", "__pycache__")]
            yield from (os.path.join(place, name) for name in sorted(names)
                        if name.endswith(ENDINGS))


def plain(text):
    """Words alone: marks, and what a value is put in, are left out."""
    return " ".join(re.findall(r"[a-z0-9_']+", text.lower()))


def read_texts():
    """The literals of all sources, those that follow each other joined."""
    texts = []
    for source in find_sources():
        with open(source, encoding="utf-8") as file:
            text = re.sub(r"\\?\"\s*\n\s*(?:f|<<\s*)?\"", "", file.read().replace('\\"', " "))
        texts += [match[1] or match[2] or "" for match in LITERAL.finditer(text)]
    return plain(" | ".join(texts))


def find_rows():
    with open(PAGE, encoding="utf-8") as file:
        lines = file.read().splitlines()
    return [re.split(r"(?<!\\)\|", line)[1].strip() for line in lines
            if line.startswith("| ") and not line.startswith("| message")]


def is_there(words, texts):
    """A short word at one end may come from elsewhere, as "is" and "but" do."""
    parts = [words]
    if len(words) > 2:
        parts += [words[1:]] * (len(words[0]) < 4) + [words[:-1]] * (len(words[-1]) < 4)
    return any(" ".join(part) in texts for part in parts)


def find_missing(row, texts):
    pieces = [plain(piece).split() for piece in VALUE.split(re.sub(r"\([^)]*\)", ";", row))]
    return [" ".join(words) for words in pieces if len(words) > 1 and not is_there(words, texts)]


TEXTS = read_texts()
wrong = 0
for row in find_rows():
    missing = find_missing(row, TEXTS)
    if missing:
        wrong += 1
        print(f"Documentation/errors.md: {row}\n  not in the sources: " + "; ".join(missing))
sys.exit(1 if wrong else 0)
