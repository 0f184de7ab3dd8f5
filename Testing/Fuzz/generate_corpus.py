#!/usr/bin/python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the files of Corpus that the project itself can write: small ones of every kind.

    PYTHONPATH=build/lib/python3/dist-packages Testing/Fuzz/generate_corpus.py

Other files stay: those that once were findings, or that the project cannot write.
"""

import itertools
import pathlib
import random

import vtklighttransport as lt
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkPoints, vtkUnsignedIntArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData

CORPUS = pathlib.Path(__file__).parent / "Corpus"


def make_image(width, height, components, ids=False):
    image = vtkImageData()
    image.SetExtent(-1, width - 2, 2, height + 1, 0, 0)
    values = vtkFloatArray()
    values.SetName("RGB" if components == 3 else "Y")
    values.SetNumberOfComponents(components)
    values.SetNumberOfTuples(width * height)
    for index in range(values.GetNumberOfValues()):
        values.SetValue(index, index % 7 / 8)
    image.GetPointData().SetScalars(values)
    if ids:
        numbers = vtkUnsignedIntArray()
        numbers.SetName("Ids")
        numbers.SetNumberOfTuples(width * height)
        numbers.Fill(3)
        image.GetPointData().AddArray(numbers)
    return image


def write_images():
    folder = CORPUS / "OpenEXR"
    for compression, tiled in itertools.product(range(10), (False, True)):
        writer = lt.vtkOpenEXRWriter()
        writer.SetCompression(compression)
        writer.SetTiled(tiled)
        writer.SetTileSize(4)
        writer.SetPixelType(compression % 2)
        write_image(writer, folder / f"{'tiles' if tiled else 'lines'}-{compression}.exr",
                    make_image(8, 6, 3, ids=compression == 3))
    writer = lt.vtkOpenEXRWriter()
    writer.SetMipLevels(True)
    writer.SetTileSize(4)
    write_image(writer, folder / "levels.exr", make_image(8, 8, 1))


def write_image(writer, file, image):
    writer.SetInputData(image)
    writer.SetFileName(str(file))
    writer.Write()


def make_squares(facing):
    """As in FuzzViewFactors.cxx."""
    squares = vtkPolyData()
    squares.SetPoints(vtkPoints())
    squares.SetPolys(vtkCellArray())
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    for square in (0, 1):
        height = 0 if (square == 0) == facing else 1
        ids = [squares.GetPoints().InsertNextPoint(x, y, height)
               for x, y in (corners if square == 0 else corners[::-1])]
        squares.GetPolys().InsertNextCell(4, ids)
    return squares


def write_view_factors():
    matrix, rays = lt.vtkViewFactors.LINK_METHOD_DENSE, lt.vtkViewFactors.LINK_METHOD_SAMPLED
    for name, facing, closed, method in (
            ("facing", True, False, matrix), ("apart", False, False, matrix),
            ("apart-closed", False, True, matrix), ("facing-rays", True, True, rays),
            ("apart-rays", False, True, rays)):
        factors = lt.vtkViewFactors()
        factors.SetInputData(make_squares(facing))
        factors.SetEnforceClosure(closed)
        factors.SetLinkMethod(method)
        factors.SetLinkTolerance(0.1)
        factors.Update()
        factors.Save(str(CORPUS / "ViewFactors" / name))


def write_choices():
    """Bytes that choose (see Choices.h): the filter, and what comes next, or hardly that much, so
    that a mutation changes everything."""
    numbers = random.Random(1)
    files = [(f"{k}", 60 * k) for k in range(3)], [(f"short-{k}", 2) for k in range(4)]
    for group in files:
        for filter_number, (name, size) in itertools.product(range(9), group):
            bytes_after = bytes(numbers.randrange(256) for _ in range(size))
            (CORPUS / "Filters" / f"{filter_number}-{name}").write_bytes(
                bytes([filter_number]) + bytes_after)


if __name__ == "__main__":
    write_images()
    write_view_factors()
    write_choices()
