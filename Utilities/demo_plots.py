# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Plots for demo.py."""

from vtklighttransport.plots import Line, plot_lines


def plot_convergence(file, histories):
    """Residual per iteration against seconds; `histories` is {label: {column: values}}."""
    lines = [
        Line(label, history["Seconds"], history["Residual"], family)
        for family, (label, history) in enumerate(histories.items())
    ]
    plot_lines(file, lines, "solver time in s", "largest residual")


def plot_error_against_time(file, rows):
    """Error against the time of form factors and solver, a line per solver through the sizes."""
    lines = []
    for family, label in enumerate(dict.fromkeys(row["Solver"] for row in rows)):
        own = [row for row in rows if row["Solver"] == label]
        seconds = [row["FormFactorSeconds"] + row["SolverSeconds"] for row in own]
        errors = [100.0 * row["RelativeError"] for row in own]
        lines.append(Line(label, seconds, errors, family))
    sizes = ", ".join(f"{size:,}" for size in sorted({row["Patches"] for row in rows}))
    plot_lines(
        file,
        lines,
        "form factors and solver, time in s",
        "error in % (root mean square over the area)",
        f"{sizes} patches from left to right",
    )
