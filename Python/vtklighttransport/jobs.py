# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Whole jobs as functions: a mesh goes in, a surface with arrays comes out; needs no numpy.

    surface = lt.radiosity("oven.stl", temperature={"heater": 900, "": 300}, emissivity=0.8)

A mesh is a VTK data set, a PyVista mesh or the name of a file; of what has blocks all are one
surface. Materials are numbers (of all patches), lists with a number for each band, arrays with a
value or row for each cell, dictionaries of these by names of regions ("" for the others), or the
name of a cell array. `progress` shows a bar on stderr; all other keywords are properties of the
filter. What a filter refuses raises LightTransportError, what it doubts is a warning.
"""

from vtklighttransport.filters import make_filter, run_filter, suggest
from vtklighttransport.lights import make_irradiance, take_light_of
from vtklighttransport.materials import set_cell_values
from vtklighttransport.meshes import get_flat_surface
from vtkmodules.vtkCommonDataModel import vtkDataObject

# Index of SetInputArrayToProcess and name of the arrays of vtkRadiosity, by keywords.
RADIOSITY_ARRAYS = {
    "emission": (0, "Emission"),
    "reflectance": (1, "Reflectance"),
    "temperature": (2, "Temperature"),
    "emissivity": (3, "Emissivity"),
    "direct_irradiance": (4, "DirectIrradiance"),
    "boundary_condition": (5, "BoundaryCondition"),
    "prescribed_net_flux": (6, "PrescribedNetFlux"),
}
BACK, BACK_SUFFIX = "_back", "Back"


def radiosity(mesh, *, lights=(), shadows=True, progress=False, **keywords):
    """The surface with Radiosity, Irradiance and NetFlux (SurfaceTemperature of thermal scenes).

    Materials: emission and reflectance, or temperature (kelvin) and emissivity, or what the mesh
    has of them; boundary_condition, prescribed_net_flux, direct_irradiance. With two_sided=True
    each may be given with _back. `lights` as those of `irradiance`.
    """
    surface = copy_surface(mesh)
    materials, properties = split(keywords, RADIOSITY_ARRAYS)
    algorithm = make_filter("vtkRadiosity", **properties)
    for keyword, value in materials.items():
        index, name = RADIOSITY_ARRAYS[keyword.removesuffix(BACK)]
        if keyword.endswith(BACK):
            set_cell_values(surface, name + BACK_SUFFIX, value)
        else:
            give(algorithm, index, surface, name, value)
    if lights:
        surface = irradiance(surface, lights=lights, shadows=shadows, progress=progress)
    return run_filter(algorithm, surface, progress)


def scatter(mesh, *, lights=(), irradiance=None, progress=False, **properties):
    """The surface with ScatteredIrradiance, of light that falls in, and is scattered inside.

    material="marble" or another one that was measured, or scattering_coefficient and
    absorption_coefficient (per mm); millimeters_per_unit. Light: `lights` as those of
    `irradiance`, or the value or array `irradiance`, or what the mesh has.
    """
    surface = copy_surface(mesh)
    algorithm = make_filter("vtkSubsurfaceScattering", **properties)
    if irradiance is not None:
        give(algorithm, 0, surface, "Irradiance", irradiance)
    if lights:
        lit = make_irradiance(lights, refractive_index=take_light_of(algorithm))
        surface = run_filter(lit, surface, progress)
    return run_filter(algorithm, surface, progress)


def irradiance(mesh, *, lights, progress=False, **properties):
    """The surface with DirectIrradiance.

    Each of `lights` is a vtkLight (pyvista.Light), or (x, y, z) or (x, y, z, intensity) for one
    from that direction, infinitely far, which gives `intensity` [1] to what faces it.
    """
    return run_filter(make_irradiance(lights, **properties), get_flat_surface(mesh), progress)


def patches(mesh, n=None, *, progress=False, **properties):
    """About `n` triangles of even size, as vtkPatchMesher makes them, repaired."""
    if n is not None:
        properties["target_number_of_patches"] = n
    return run_filter(make_filter("vtkPatchMesher", **properties), get_flat_surface(mesh), progress)


def atlas(mesh, *, progress=False, **properties):
    """The surface unfolded: AtlasCoordinates are its texture coordinates, ChartId its charts."""
    return run_filter(make_filter("vtkSurfaceAtlas", **properties), get_flat_surface(mesh),
                      progress)


def copy_surface(mesh):
    """Arrays can be added without the mesh knowing of it."""
    surface = get_flat_surface(mesh)
    copy = surface.NewInstance()
    copy.ShallowCopy(surface)
    return copy


def split(keywords, arrays):
    """Materials, and the rest, which are properties."""
    names = {*arrays, *(keyword + BACK for keyword in arrays)}
    materials = {key: value for key, value in keywords.items()
                 if key in names and value is not None}
    properties = {key: value for key, value in keywords.items() if key not in names}
    for key in properties:
        near = suggest(key, arrays)
        if near:
            raise TypeError(f"there is no material '{key}'; did you mean '{near}'?")
    return materials, properties


def give(algorithm, index, surface, name, value):
    """The name of an array chooses it, all else becomes the array `name`."""
    if isinstance(value, str):
        algorithm.SetInputArrayToProcess(
            index, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, value)
    else:
        set_cell_values(surface, name, value)
