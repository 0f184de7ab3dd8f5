# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""One-value field data arrays, in which filters sum up a run; without numpy."""

from vtkmodules.vtkCommonDataModel import vtkFieldData, vtkPolyData


def find_summary(data, *names):
    """The first of these that the data set has, as float or str; None where it has none."""
    for name in names:
        array = data.GetFieldData().GetAbstractArray(name)
        if array is not None:
            return array.GetValue(0)
    return None


def get_summary(data, name):
    """A one-value field data array, as float or str; KeyError where there is none of that name."""
    value = find_summary(data, name)
    if value is None:
        raise KeyError(name)
    return value


def list_summaries(data):
    """All one-value field data arrays by their names."""
    fields = data.GetFieldData()
    arrays = [fields.GetAbstractArray(k) for k in range(fields.GetNumberOfArrays())]
    return {array.GetName(): array.GetValue(0) for array in arrays
            if array is not None and array.GetNumberOfValues() == 1}


def without_summaries(surface):
    """A copy that nothing is known of from earlier runs."""
    copy = vtkPolyData()
    copy.ShallowCopy(surface)
    copy.SetFieldData(vtkFieldData())
    return copy
