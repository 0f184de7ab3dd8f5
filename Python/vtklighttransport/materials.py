# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Materials as plain values: a number for all patches, or for a region; needs no numpy."""

from vtklighttransport.filters import suggest
from vtklighttransport.meshes import REGION, list_regions
from vtkmodules.vtkCommonCore import vtkDoubleArray

# Of values by region: what holds for all that are not named.
EVERYWHERE = ""


def is_number(value):
    return isinstance(value, (int, float)) or getattr(value, "ndim", None) == 0


def set_cell_values(surface, name, value):
    """Adds the cell array `name`. The value is one of

    - a number, or one for each band, that all cells have;
    - an array or list of one number, or row, for each cell;
    - a dictionary of the first kind by names of regions, EVERYWHERE for all others, which else
      keep what the array has.
    """
    if isinstance(value, dict):
        set_by_region(surface, name, value)
    elif is_number(value) or len(value) != surface.GetNumberOfCells():
        refuse_points(surface, name, value)
        surface.GetCellData().AddArray(make_array(surface, name, value))
    else:
        from vtklighttransport.arrays import set_cell_array
        set_cell_array(surface, name, value)


def make_array(surface, name, value):
    row = to_row(name, value, surface.GetNumberOfCells())
    array = vtkDoubleArray()
    array.SetName(name)
    array.SetNumberOfComponents(len(row))
    array.SetNumberOfTuples(surface.GetNumberOfCells())
    for component, number in enumerate(row):
        array.FillComponent(component, number)
    return array


def to_row(name, value, count):
    row = (value,) if is_number(value) else tuple(value)
    try:
        row = tuple(float(number) for number in row)
    except (TypeError, ValueError):
        row = ()
    if not 0 < len(row) <= 64:
        raise ValueError(f"{name} must be a number, or one for each band, or one for each of the "
                         f"{count} cells, not {describe(value)}")
    return row


def refuse_points(surface, name, value):
    """One for each band, and by chance as many as there are points, is a list or tuple."""
    count = surface.GetNumberOfPoints()
    if hasattr(value, "shape") and value.shape and value.shape[0] == count:
        raise ValueError(f"{name} has a value for each of the {count} points: patches are cells, "
                         "take the means of their corners (point_data_to_cell_data)")


def describe(value):
    shape = getattr(value, "shape", None)
    return f"an array of shape {shape}" if shape is not None else f"{value!r:.60}"


def set_by_region(surface, name, values):
    if not values:
        raise ValueError(f"{name} has no value: the dictionary is empty")
    regions = list_regions(surface)
    numbers = {}
    for region in values:
        if region != EVERYWHERE:
            numbers.update({number: region for number in find_region(region, regions, name)})
    array = take_base(surface, name, values, set(regions) - set(numbers), regions)
    rows = {number: to_row(name, values[region], 0) for number, region in numbers.items()}
    for region, row in rows.items():
        if len(row) != array.GetNumberOfComponents():
            raise ValueError(f"{name} of the region '{regions[region]}' has {len(row)} values, and "
                             f"elsewhere it has {array.GetNumberOfComponents()}: give as many "
                             "everywhere")
    if rows:
        cells = surface.GetCellData().GetArray(REGION)
        for cell in range(surface.GetNumberOfCells()):
            row = rows.get(cells.GetTuple1(cell))
            if row is not None:
                array.SetTuple(cell, row)
    surface.GetCellData().AddArray(array)


def find_region(region, regions, name):
    """Numbers of all regions of that name."""
    if not regions:
        raise ValueError(f"{name} of the region '{region}': the mesh has no regions; they are the "
                         f"solids or groups that its file names, or the cell array \"{REGION}\" of "
                         "integers")
    numbers = [number for number, known in regions.items() if known == region]
    if not numbers:
        near = suggest(region, regions.values())
        raise ValueError(f"{name}: there is no region '{region}'"
                         + (f", did you mean '{near}'?" if near else "")
                         + "; there are " + ", ".join(regions.values()))
    return numbers


def take_base(surface, name, values, others, regions):
    """What regions have that are not named."""
    if EVERYWHERE in values:
        return make_array(surface, name, values[EVERYWHERE])
    before = surface.GetCellData().GetArray(name)
    if before is not None:
        array = vtkDoubleArray()
        array.DeepCopy(before)
        return array
    if others:
        raise ValueError(f"{name} of {', '.join(regions[number] for number in sorted(others))} is "
                         "not given: give these regions a value, or all that are not named one")
    return make_array(surface, name, next(iter(values.values())))
