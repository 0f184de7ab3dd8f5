# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Plots for demo.py."""

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot


def save(figure, file):
    figure.tight_layout()
    figure.savefig(file, dpi=100)
    pyplot.close(figure)


def plot_convergence(file, histories):
    """Residual per iteration against seconds; `histories` is {label: {column: values}}."""
    figure, axes = pyplot.subplots(figsize=(7, 4.5))
    for label, history in histories.items():
        axes.plot(history["Seconds"], history["Residual"], marker=".", label=label)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("solver time in s")
    axes.set_ylabel("largest residual")
    axes.grid(True, alpha=0.3)
    axes.legend()
    save(figure, file)


def plot_error_against_time(file, rows):
    """Error against the time of form factors and solver, one line per solver through the numbers of patches."""
    figure, axes = pyplot.subplots(figsize=(7, 4.5))
    for label in dict.fromkeys(row["Solver"] for row in rows):
        own = [row for row in rows if row["Solver"] == label]
        seconds = [row["FormFactorSeconds"] + row["SolverSeconds"] for row in own]
        errors = [100.0 * row["RelativeError"] for row in own]
        axes.plot(seconds, errors, marker="o", label=label)
    seen = set()
    for row in rows:
        if row["Patches"] not in seen:
            seen.add(row["Patches"])
            position = (row["FormFactorSeconds"] + row["SolverSeconds"], 100.0 * row["RelativeError"])
            axes.annotate(
                f"{row['Patches']} patches", position, textcoords="offset points", xytext=(4, 6)
            )
    axes.set_xscale("log")
    axes.set_yscale("log")
    # Room for the last label.
    axes.margins(x=0.15)
    axes.set_xlabel("form factors and solver, time in s")
    axes.set_ylabel("error in % (root mean square over the area)")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    save(figure, file)
