# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces from files of any kind that VTK reads, or meshio where it is there; needs no numpy.

Regions are what a file names: solids of an STL, blocks, physical groups. They become the cell array
"Region" of integers and the field data array "RegionNames" that names them, in that order.
"""

import importlib
import importlib.util
import os

from vtklighttransport.filters import LightTransportError, run_filter, suggest
from vtkmodules.vtkCommonCore import vtkIntArray, vtkStringArray

REGION, REGION_NAMES = "Region", "RegionNames"

READERS = {
    ".vtp": ("vtkIOXML", "vtkXMLPolyDataReader"),
    ".vtk": ("vtkIOLegacy", "vtkGenericDataObjectReader"),
    ".ply": ("vtkIOPLY", "vtkPLYReader"),
    ".stl": ("vtkIOGeometry", "vtkSTLReader"),
    ".obj": ("vtkIOGeometry", "vtkOBJReader"),
    ".vtu": ("vtkIOXML", "vtkXMLUnstructuredGridReader"),
    ".vts": ("vtkIOXML", "vtkXMLStructuredGridReader"),
    ".vtm": ("vtkIOXML", "vtkXMLMultiBlockDataReader"),
    ".pvtp": ("vtkIOXML", "vtkXMLPPolyDataReader"),
    ".pvtu": ("vtkIOXML", "vtkXMLPUnstructuredGridReader"),
    ".vtkhdf": ("vtkIOHDF", "vtkHDFReader"),
    ".glb": ("vtkIOGeometry", "vtkGLTFReader"),
    ".gltf": ("vtkIOGeometry", "vtkGLTFReader"),
    ".byu": ("vtkIOGeometry", "vtkBYUReader"),
    ".g": ("vtkIOGeometry", "vtkBYUReader"),
    ".foam": ("vtkIOGeometry", "vtkOpenFOAMReader"),
    ".ucd": ("vtkIOGeometry", "vtkAVSucdReader"),
    ".case": ("vtkIOEnSight", "vtkGenericEnSightReader"),
    ".cgns": ("vtkIOCGNSReader", "vtkCGNSReader"),
    ".e": ("vtkIOExodus", "vtkExodusIIReader"),
    ".exo": ("vtkIOExodus", "vtkExodusIIReader"),
}


def get_extension(file):
    return os.path.splitext(file)[1].lower()


def list_extensions():
    """What can be read here, the best known first."""
    try:
        from meshio import extension_to_filetypes
    except ImportError:
        return list(READERS)
    return list(READERS) + sorted(set(extension_to_filetypes) - set(READERS))


def check_extension(file):
    """ValueError with the remedy where nothing reads the file."""
    extension = get_extension(file)
    # meshio takes a while to load.
    if extension not in READERS and extension not in list_extensions():
        raise ValueError(f"'{file}' is none of {', '.join(list_extensions())}" + (
            "" if has_meshio() else "; with meshio (Debian: python3-meshio) many more are read"))


def has_meshio():
    return importlib.util.find_spec("meshio") is not None


def read_mesh(file, progress=False):
    """The surface in a file, a vtkPolyData. OSError or ValueError says what prevents it."""
    check_extension(file)
    if not os.path.isfile(file):
        raise FileNotFoundError(f"cannot read {file}: no such file")
    try:
        data = read_data(file, progress)
    except LightTransportError as error:
        raise ValueError(f"cannot read {file}: {error}") from error
    surface = extract_surface(data)
    if surface.GetNumberOfPoints() == 0:
        raise ValueError(f"cannot read {file}: no surface in it")
    return surface


def read_data(file, progress):
    """What VTK or meshio makes of it."""
    if get_extension(file) not in READERS:
        return read_with_meshio(file)
    reader = make_reader(file)
    data = run_filter(reader, progress=progress)
    if get_extension(file) == ".stl":
        name_solids(file, data)
    return data


def make_reader(file):
    module, name = READERS[get_extension(file)]
    try:
        reader = getattr(importlib.import_module("vtkmodules." + module), name)()
    except (ImportError, AttributeError) as error:
        raise ValueError(f"cannot read {file}: this VTK has no {name}") from error
    if name == "vtkGenericEnSightReader":
        reader.SetCaseFileName(file)
    else:
        reader.SetFileName(file)
    if name == "vtkSTLReader":
        reader.ScalarTagsOn()
    if name == "vtkOpenFOAMReader":
        choose_boundary(reader)
    return reader


def choose_boundary(reader):
    """The boundary, and not the outside of the volume too, which is the same place."""
    reader.UpdateInformation()
    for k in range(reader.GetNumberOfPatchArrays()):
        name = reader.GetPatchArrayName(k)
        reader.SetPatchArrayStatus(name, int("internalMesh" not in name))


def name_solids(file, surface):
    """VTK numbers the solids of a text file, which has their names."""
    tags = surface.GetCellData().GetArray("STLSolidLabeling")
    if tags is None:
        return
    surface.GetCellData().RemoveArray("STLSolidLabeling")
    with open(file, encoding="utf-8", errors="replace") as stream:
        solids = [line.split(None, 1)[1:] for line in stream
                  if line.split(None, 1)[:1] == ["solid"]]
    if len(solids) > 1:
        numbers = [int(tags.GetTuple1(cell)) for cell in range(tags.GetNumberOfTuples())]
        set_regions(surface, numbers, [solid[0].strip() if solid else "" for solid in solids])


def set_regions(surface, numbers, names):
    regions = vtkIntArray()
    regions.SetName(REGION)
    regions.SetNumberOfTuples(len(numbers))
    for cell, number in enumerate(numbers):
        regions.SetValue(cell, number)
    surface.GetCellData().AddArray(regions)
    texts = vtkStringArray()
    texts.SetName(REGION_NAMES)
    for name in names:
        texts.InsertNextValue(name)
    surface.GetFieldData().AddArray(texts)


def list_regions(surface):
    """Names of the regions by their numbers; numbers are their own names where nothing else is."""
    numbers = surface.GetCellData().GetArray(REGION)
    if numbers is None:
        return {}
    names = surface.GetFieldData().GetAbstractArray(REGION_NAMES)
    known = [] if names is None else [names.GetValue(k) for k in range(names.GetNumberOfValues())]
    found = sorted({numbers.GetTuple1(cell) for cell in range(numbers.GetNumberOfTuples())})
    return {number: known[int(number)] if 0 <= number < len(known) else f"{number:g}"
            for number in found}


def check_cell_array(surfaces, name):
    """ValueError where none of them has it, with the one that was meant."""
    names = {cells.GetArrayName(k) or "" for cells in (each.GetCellData() for each in surfaces)
             for k in range(cells.GetNumberOfArrays())}
    if name not in names:
        near = suggest(name, names)
        raise ValueError(f"there is no cell array '{name}'"
                         + (f", did you mean '{near}'?" if near else ""))


def is_mesh(value):
    return isinstance(value, (str, os.PathLike)) or hasattr(value, "IsA")


def get_surface(mesh):
    """A mesh as filters take it: surfaces and blocks of them as they are, of all else its surface,
    of the name of a file what is in it."""
    if not is_mesh(mesh):
        raise TypeError(
            f"a mesh is a VTK data set or the name of a file, not {type(mesh).__name__}")
    if not hasattr(mesh, "IsA"):
        return read_mesh(os.fspath(mesh))
    if mesh.IsA("vtkPolyData") or mesh.IsA("vtkCompositeDataSet"):
        return mesh
    return extract_surface(mesh)


def get_flat_surface(mesh):
    """As `get_surface`, of blocks all in one."""
    return extract_surface(get_surface(mesh))


def extract_surface(data):
    """A vtkPolyData: what it is, or the outer faces of it; of blocks all in one, as regions."""
    if data.IsA("vtkCompositeDataSet"):
        return join_blocks(data)
    if data.IsA("vtkPolyData"):
        return data
    if not data.IsA("vtkDataSet"):
        raise ValueError(f"there is no surface in a {data.GetClassName()}")
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
    return run_filter(vtkGeometryFilter(), data)


def join_blocks(blocks):
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
    from vtkmodules.vtkFiltersCore import vtkAppendPolyData
    append, numbers, names = vtkAppendPolyData(), [], []
    iterator = blocks.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        data = iterator.GetCurrentDataObject()
        if data.IsA("vtkDataSet") and data.GetNumberOfCells():
            part = extract_surface(data)
            information = blocks.GetMetaData(iterator)
            name = information.Get(vtkCompositeDataSet.NAME()) if information else None
            append.AddInputData(part)
            numbers += [len(names)] * part.GetNumberOfCells()
            names.append(name or str(len(names)))
        iterator.GoToNextItem()
    if not names:
        raise ValueError("there is no surface in any block")
    joined = run_filter(append)
    if not joined.GetCellData().HasArray(REGION):
        set_regions(joined, numbers, names)
    return joined


def read_with_meshio(file):
    """Points, cells, cell arrays and physical groups."""
    import meshio

    from vtklighttransport.conversion import convert_meshio
    try:
        return convert_meshio(meshio.read(file))
    except (meshio.ReadError, OSError, ValueError, KeyError, IndexError) as error:
        raise ValueError(f"cannot read {file}: {error or type(error).__name__}") from error
    except SystemExit as error:
        # So does meshio with what it does not understand.
        raise ValueError(f"cannot read {file}: meshio does not understand it") from error
