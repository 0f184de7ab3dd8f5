# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""View factors as a matrix; needs numpy, and takes scipy and pandas where they are.

matrix      ViewFactorMatrix, and how a mesh gets one
verdict     whether a matrix can be right, and the smallest change that makes it so
files       matrices in files: NumPy's, and tables
foreign     those of View3D and OpenFOAM
"""

from vtklighttransport.factors.matrix import (
    ViewFactorMatrix, read_view_factors, view_factors)
from vtklighttransport.factors.verdict import Verdict

__all__ = ["Verdict", "ViewFactorMatrix", "read_view_factors", "view_factors"]
