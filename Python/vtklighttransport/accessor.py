# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""`mesh.light_transport` of every PyVista mesh. PyVista loads this when that is first asked for.

Methods are the functions of `jobs` and `view_factors` of `factors`, with the mesh as their first
argument; what they give are PyVista meshes.
"""

import functools

import pyvista

import vtklighttransport as lt
from vtklighttransport import jobs
from vtklighttransport.factors import view_factors
from vtklighttransport.filters import make_filter


def as_method(job):
    @functools.wraps(job)
    def method(self, *arguments, **keywords):
        return pyvista.wrap(job(self.mesh, *arguments, **keywords))
    return method


@pyvista.register_dataset_accessor("light_transport", pyvista.DataObject)
class LightTransportAccessor:
    """Light transport on the surface of a mesh."""

    def __init__(self, mesh):
        self.mesh = mesh

    radiosity = as_method(jobs.radiosity)
    scatter = as_method(jobs.scatter)
    irradiance = as_method(jobs.irradiance)
    patches = as_method(jobs.patches)
    atlas = as_method(jobs.atlas)

    @functools.wraps(view_factors)
    def view_factors(self, **keywords):
        matrix = view_factors(self.mesh, **keywords)
        matrix.mesh = pyvista.wrap(matrix.mesh)
        return matrix

    def add_translucent(self, plotter, *, specular=0.1, specular_power=30.0, exposure=1.0,
                        map_size=128, **material):
        """Adds the mesh, as `atlas` made it, to a plotter that scatters while it draws.

        `material`: properties of vtkSubsurfaceScattering, material="marble". Lights are those of
        the plotter; make it with lighting="none" and add light_type="scene light". Returns the
        actor and the vtkSubsurfaceScatteringPass.
        """
        actor = make_actor(self.mesh, specular, specular_power)
        scattering = plotter.renderer.GetPass()
        if not isinstance(scattering, lt.vtkSubsurfaceScatteringPass):
            scattering = lt.vtkSubsurfaceScatteringPass()
            plotter.renderer.SetPass(scattering)
        scattering.SetMaterial(actor, make_filter("vtkSubsurfaceScattering", **material))
        scattering.SetExposure(exposure)
        scattering.SetScatteredMapSize(map_size)
        scattering.SetIrradianceMapSize(4 * map_size)
        plotter.add_actor(actor)
        return actor, scattering


def make_actor(surface, specular, specular_power):
    """What the pass draws: reflections like those of a mirror are the actor's own."""
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface.compute_normals(split_vertices=False, consistent_normals=False))
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetAmbient(0.0)
    look.SetDiffuse(0.0)
    look.SetSpecular(specular)
    look.SetSpecularPower(specular_power)
    return actor
