# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Matrices of other programs. What is read are the arguments of ViewFactorMatrix.

View3D    format 0, text: a line "View3D version format encl didemit n", a line of n areas, n lines
          of n view factors, a line of emittances
OpenFOAM  the lists that viewFactorsGen writes into constant/, as text: "F" has the view factors of
          each coarse face, "globalFaceFaces" the numbers of the faces that they belong to
"""

import os
import re

import numpy

TOKEN = re.compile(r"[(){}]|[^\s(){};]+")


def read(file, faces=None):
    """None where the file is of neither program."""
    with open(file, "rb") as stream:
        start = stream.read(4096)
    if start[:6].lower() == b"view3d":
        return read_view3d(file)
    if b"FoamFile" in start or faces is not None:
        return read_openfoam(file, faces or os.path.join(os.path.dirname(file), "globalFaceFaces"))
    return None


def read_view3d(file):
    with open(file, "rb") as stream:
        header = stream.readline().split()
        body = stream.read()
    try:
        form, _, with_emittances, count = (int(word) for word in header[-4:])
    except ValueError as error:
        raise ValueError(f"{file}: the first line must be 'View3D version format encl didemit n', "
                         f"but it is {header}") from error
    if form != 0:
        raise ValueError(f"{file} is binary (format {form}): let View3D write 'out 0', text")
    if with_emittances:
        raise ValueError(f"{file} has emittances worked into its numbers, which are then no view "
                         "factors: let View3D write them with 'emit 0'")
    numbers = parse_numbers(file, body.split())
    if count < 1 or len(numbers) not in (count * (count + 1), count * (count + 2)):
        raise ValueError(f"{file} has {len(numbers)} numbers, but {count} surfaces have "
                         f"{count * (count + 2)}: it is cut short or damaged")
    return {"areas": numbers[:count],
            "factors": numbers[count:count * (count + 1)].reshape(count, count)}


def read_openfoam(file, faces):
    if not os.path.isfile(faces):
        raise FileNotFoundError(
            f"{file} has view factors without the numbers of their faces: give the file "
            f"globalFaceFaces as `faces`; there is no {faces}")
    rows, columns = read_lists(file), read_lists(faces)
    count = len(rows)
    lengths = [len(row) for row in rows]
    if lengths != [len(row) for row in columns]:
        raise ValueError(
            f"{file} and {faces} are of different scenes: their lists differ in length")
    places = numpy.concatenate([*columns, []])
    if len(places) and not ((places >= 0) & (places < count) & (places % 1 == 0)).all():
        raise ValueError(f"{faces} names faces that are not there: there are {count}")
    sender = numpy.repeat(numpy.arange(count), lengths)
    values = numpy.concatenate([*rows, []])
    factors = numpy.zeros((count, count))
    numpy.add.at(factors, (sender, places.astype(int)), values)
    return {"factors": factors}


def read_lists(file):
    """Lists of numbers in a list: N ( n ( a b c ) n { a } ... ), counts optional."""
    with open(file, encoding="utf-8", errors="replace") as stream:
        text = stream.read()
    if re.search(r"format\s+binary", text[:4096]):
        raise ValueError(f"{file} is binary: write it with 'writeFormat ascii', or convert it with "
                         "foamFormatConvert")
    text = re.sub(r"/\*.*?\*/|//[^\n]*", " ", text, flags=re.DOTALL)
    text = re.sub(r"FoamFile\s*\{.*?\}", " ", text, flags=re.DOTALL)
    lists = collect_lists(file, TOKEN.findall(text))
    if not lists:
        raise ValueError(f"{file} has no list of lists: it is cut short or damaged")
    return lists


def collect_lists(file, tokens):
    lists, depth, count, words = [], 0, None, []
    for token in tokens:
        if token in "({":
            depth += 1
            count, words = words[-1:] if depth == 2 else None, []
        elif token in ")}":
            if depth == 2:
                numbers = parse_numbers(file, words)
                lists.append(spread(file, numbers, count, token))
            depth, words = depth - 1, []
        else:
            words.append(token)
    if depth:
        raise ValueError(f"{file} ends in the midst of a list: it is cut short")
    return lists


def spread(file, numbers, count, end):
    """n { a } is a n times; a count says how many there must be."""
    wanted = int(parse_numbers(file, count)[0]) if count else len(numbers)
    if end == "}" and len(numbers) == 1:
        numbers = numpy.repeat(numbers, min(wanted, 10**8))
    if len(numbers) != wanted:
        raise ValueError(f"{file}: a list has {len(numbers)} numbers, but says {wanted}")
    return numbers


def parse_numbers(file, words):
    try:
        return numpy.array([float(word) for word in words])
    except ValueError as error:
        raise ValueError(f"{file} is damaged: {error}") from error
