# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""View factors as a matrix, from a mesh or from numbers."""

import numpy

from vtklighttransport.arrays import get_areas
from vtklighttransport.factors import files, foreign, verdict
from vtklighttransport.filters import LightTransportError, make_filter, run_filter
from vtklighttransport.leaves import gather_cell_array, list_leaves
from vtklighttransport.meshes import (
    check_cell_array, get_flat_surface, get_surface, is_mesh)
from vtklighttransport.replacement import replace_file
from vtklighttransport.summaries import list_summaries
from vtkmodules.util import numpy_support

# Where no more than this part of a matrix is not zero, scipy's sparse form takes less memory.
SPARSE_SHARE = 0.25
BLOCK_BYTES = 1 << 25


class ViewFactorMatrix:
    """F[i, j], the fraction of what leaves patch i that reaches patch j, and what goes with it.

    factors     numpy array of n x n, or scipy.sparse.csr_matrix where most are zero
    areas       of each patch, or None where nothing tells
    sky         what leaves the scene from each patch
    back_faces  what meets back faces
    errors      estimate of sum_j |error of F_ij|, or of the two above where that is larger; NaN
                where nothing tells
    groups      columns of the table between groups by their names; empty where there is none
    summary     what the filter tells of the run: EnclosureVerdict, RaysCast, ...
    mesh        the surface with the arrays of vtkViewFactors; None where there is none

    `matrix[i, j]`, `matrix @ values` and `numpy.asarray(matrix)` are those of the factors.
    """

    def __init__(self, factors, areas=None, *, sky=None, back_faces=None, errors=None,
                 groups=None, summary=None, mesh=None):
        if hasattr(factors, "tocsr"):
            factors = factors.tocsr().astype(numpy.float64)
        else:
            factors = numpy.asarray(factors, dtype=numpy.float64)
        if factors.ndim != 2 or factors.shape[0] != factors.shape[1]:
            raise ValueError("view factors must be a square matrix, but the shape is "
                             f"{factors.shape}")
        self.factors = factors
        self.areas = None if areas is None else self._check_column("areas", areas)
        self.sky = self._check_column("sky", sky, 0.0)
        self.back_faces = self._check_column("back_faces", back_faces, 0.0)
        self.errors = self._check_column("errors", errors, numpy.nan)
        self.groups = groups or {}
        self.summary = summary or {}
        self.mesh = mesh

    def _check_column(self, name, values, default=None):
        if values is None:
            return numpy.full(len(self), default)
        column = numpy.asarray(values, dtype=numpy.float64).ravel()
        if len(column) != len(self):
            raise ValueError(f"{name} has {len(column)} values, but there are {len(self)} patches")
        if name == "areas" and not (numpy.isfinite(column) & (column >= 0.0)).all():
            raise ValueError("areas must be finite and not negative")
        return column

    def __len__(self):
        return self.factors.shape[0]

    def __getitem__(self, index):
        return self.factors[index]

    def __matmul__(self, values):
        return self.factors @ values

    def __array__(self, dtype=None, copy=None):
        whole = self.factors.toarray() if self.is_sparse else self.factors
        return numpy.array(whole, dtype=dtype) if copy else numpy.asarray(whole, dtype=dtype)

    def __repr__(self):
        form = "sparse" if self.is_sparse else "dense"
        return f"<ViewFactorMatrix: {len(self)} patches, {form}>"

    @property
    def is_sparse(self):
        return verdict.is_sparse(self.factors)

    @property
    def sums(self):
        """Of each row, without sky and back faces."""
        return verdict.sum_rows(self.factors)

    def check(self, tolerance=1e-3):
        """Whether it can be right: bounds, row sums, reciprocity."""
        return verdict.judge(self.factors, self.areas, self.sky + self.back_faces, tolerance)

    def repaired(self, closed=False):
        """Another one that is reciprocal, has nothing negative, and no row above 1.

        `closed`: rows sum to 1 with their sky and back faces. Needs areas.
        """
        if self.areas is None:
            raise ValueError("a repair needs the areas of the patches: "
                             "ViewFactorMatrix(matrix.factors, areas).repaired()")
        factors = verdict.repair(self.factors, self.areas, self.sky + self.back_faces, closed)
        return ViewFactorMatrix(factors, self.areas, sky=self.sky, back_faces=self.back_faces)

    def group_table(self):
        """The table between groups as pandas.DataFrame, a row for each group that sends."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("group_table() needs pandas (Debian: python3-pandas); `groups` has "
                              "the same columns without it") from error
        table = pandas.DataFrame(self.groups)
        return table.set_index("Group") if "Group" in table else table

    def save(self, file):
        """NumPy's .npz, as read_view_factors reads it; scipy.sparse.load_npz reads sparse ones."""
        replace_file(file, files.pack(self))

    def to_csv(self, file, pairs=False):
        """A line for each patch with its view factors; or for each pair that is not zero."""
        replace_file(file, (files.print_pairs if pairs else files.print_table)(self).encode())


def view_factors(mesh, *, group=None, progress=False, **properties):
    """The view factors of a mesh, a ViewFactorMatrix.

    mesh        vtkPolyData, composite data set of them, PyVista mesh, or the name of a file
    group       cell array of integers that divides patches into groups ["Group", else blocks]
    progress    a bar on stderr
    properties  of vtkViewFactors: tolerance=1e-3, enforce_closure=False, two_sided=False; with
                two_sided backs are rows n to 2 n - 1
    """
    surface = get_surface(mesh)
    algorithm = make_filter("vtkViewFactors", **properties)
    if group is not None:
        check_cell_array(list_leaves(surface), group)
        algorithm.SetInputArrayToProcess(0, 0, 0, 1, group)
    run_filter(algorithm, surface, progress)
    return make_matrix(algorithm)


def make_matrix(algorithm):
    """Of a vtkViewFactors that is up to date."""
    result = algorithm.GetOutputDataObject(0)
    sides = ("", "Back") if algorithm.GetTwoSided() else ("",)

    def gather(name):
        return numpy.concatenate([gather_cell_array(result, name + side) for side in sides])

    sky = gather("SkyFraction")
    return ViewFactorMatrix(
        take_factors(algorithm, len(sky)), take_areas(algorithm, len(sky)), sky=sky,
        back_faces=gather("BackFaceFraction"), errors=gather("ViewFactorError"),
        groups=take_table(algorithm.GetGroupTable()), summary=list_summaries(result),
        mesh=result)


def read_view_factors(file, areas=None, faces=None):
    """A ViewFactorMatrix from a file: what `save` or scipy.sparse.save_npz has written, an .npz or
    .npy with a square array, a table of `to_csv`, the text form of View3D, or OpenFOAM's F.

    areas  of the patches, or the mesh with them, where the file has none
    faces  OpenFOAM's file globalFaceFaces [the one beside F]

    Ask `check()` of it before you believe it.
    """
    columns = foreign.read(file, faces) or files.read(file)
    if areas is not None:
        columns["areas"] = get_areas(get_flat_surface(areas)) if is_mesh(areas) else areas
    return ViewFactorMatrix(**columns)


def take_areas(algorithm, count):
    areas = numpy.zeros(count)
    if not algorithm.GetPatchAreas(numpy_support.numpy_to_vtk(areas)):
        raise LightTransportError("the filter has other patches than its output; update it first")
    return areas


def take_factors(algorithm, count):
    """Dense, or sparse where most are zero and scipy is there."""
    try:
        import scipy.sparse
    except ImportError:
        scipy = None
    stored = 0
    if scipy:
        stored = sum(numpy.count_nonzero(block) for block in walk_rows(algorithm, count))
    if scipy is None or stored > SPARSE_SHARE * count * count:
        factors = numpy.empty((count, count))
        fill_rows(algorithm, 0, factors)
        return factors
    blocks = [scipy.sparse.csr_matrix(block) for block in walk_rows(algorithm, count)]
    return scipy.sparse.vstack(blocks, format="csr") if blocks else numpy.empty((0, 0))


def walk_rows(algorithm, count):
    """Blocks of rows, one after another in the same memory."""
    height = max(1, BLOCK_BYTES // (8 * max(count, 1)))
    block = numpy.empty((min(height, count), count))
    for first in range(0, count, height):
        rows = block[:count - first]
        fill_rows(algorithm, first, rows)
        yield rows


def fill_rows(algorithm, first, rows):
    if rows.size and not algorithm.GetViewFactors(first, numpy_support.numpy_to_vtk(rows)):
        raise LightTransportError("the filter has other patches than its output; update it first")


def take_table(table):
    """A vtkTable as columns by their names."""
    columns = {}
    for k in range(table.GetNumberOfColumns()):
        column = table.GetColumn(k)
        columns[table.GetColumnName(k)] = [
            column.GetValue(row) for row in range(table.GetNumberOfRows())]
    return {name: values if name == "Group" else numpy.array(values)
            for name, values in columns.items()}
