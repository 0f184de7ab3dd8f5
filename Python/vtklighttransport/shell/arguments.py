# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Values of options: lists of numbers, and vectors."""

import argparse
import re

from vtklighttransport.filters import suggest
from vtklighttransport.materials import EVERYWHERE


def parse_numbers(text, kind=float, name="numbers"):
    try:
        return [kind(part) for part in text.split(",")]
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"'{text}' is no list of {name}") from error


def parse_whole_numbers(text):
    return parse_numbers(text, int, "whole numbers")


def parse_material(text):
    """A value or one for each band, of all patches or of a region; else the name of an array."""
    region, found, numbers = text.rpartition("=")
    if found:
        return {region: parse_numbers(numbers)}
    try:
        return {EVERYWHERE: parse_numbers(text)}
    except argparse.ArgumentTypeError:
        return text


def parse_light(text):
    return parse_vector(text, (3, 4), "X,Y,Z or X,Y,Z,INTENSITY")


def parse_direction(text):
    return parse_vector(text, (3,), "X,Y,Z")


def parse_vector(text, counts, form):
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in counts or not any(numbers[:3]):
        raise argparse.ArgumentTypeError(f"'{text}' is not {form}")
    return numbers


def join_negative_values(arguments):
    """`--light -1,0,0` as `--light=-1,0,0`: to argparse only a plain number is no option."""
    joined = []
    for argument in arguments:
        if (joined and re.fullmatch(r"--[a-z-]+", joined[-1]) and re.match(r"-[\d.]", argument)
                and not re.fullmatch(r"-\d+|-\d*\.\d+", argument)):
            joined[-1] += "=" + argument
        else:
            joined.append(argument)
    return joined


def refuse_unknown(parser, unknown):
    """Wrong usage that names each, and the option that was meant."""
    flags = re.findall(r"--[a-z-]+", parser.format_usage())
    nearest = {word: suggest(word.partition("=")[0], flags) for word in unknown}
    parser.error("unrecognized arguments: " + " ".join(
        f"{word} (did you mean {near}?)" if near else word for word, near in nearest.items()))


def check_range(options, flag, value, low, high):
    """Wrong usage where the value, also one that is not a number, is not from low to high."""
    if not low <= value <= high:
        refuse_value(options, flag, value)


def refuse_value(options, flag, value):
    options.parser.error(f"argument {flag}: {value:g} is out of range")
