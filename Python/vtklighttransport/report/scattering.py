# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The report of subsurface scattering: models beside Monte Carlo in the same body.

The reference has errors of chance, which it tells of each patch. A difference from it is larger
than the error of what is compared: their squares, summed over the surface, are taken off, and what
chance makes of the rest is told as a range.
"""

import dataclasses
import math

import numpy

from vtklighttransport.filters import find_choices
from vtklighttransport.report.subject import (
    FIRST_COLUMNS, LAST_COLUMNS, Method, Subject, find_constants, whole)
from vtklighttransport.lights import find_material
from vtklighttransport.shell.properties import find_class
from vtklighttransport.summaries import find_summary
from vtkmodules.util.numpy_support import vtk_to_numpy

BANDS = ("red", "green", "blue")
# Standard errors to both sides: 95 of 100 ranges hold what they are of.
RANGE = 2.0
# Of all patches in pictures, those within the range of their colours.
SHOWN = 0.98


class Scattering(Subject):
    TITLE = "Subsurface scattering"
    QUANTITY = "scattered irradiance"
    ARRAY = "ScatteredIrradiance"
    COLUMNS = {
        **FIRST_COLUMNS,
        "links": ("links", ">12", ",d"),
        "photons": ("photons", ">12", ",d"),
        "error_l2": ("L2 error", ">9", ".2%"),
        "error_l2_low": ("from", ">8", ".2%"),
        "error_l2_high": ("to", ">8", ".2%"),
        "error_worst_band": ("worst band", ">10", ".2%"),
        "worst_band": ("which", "<6", ""),
        "ratio_total": ("total", ">7", ".4f"),
        "ratio_total_error": ("+-", ">7", ".4f"),
        "error_stated": ("stated", ">8", ".2%"),
        "error_reference": ("MC error", ">9", ".2%"),
        **LAST_COLUMNS,
    }
    TIME = ("seconds_cpu", "CPU seconds")
    GROWTH = (("growth_seconds.png", "seconds_cpu", "CPU seconds"),)
    EXPONENTS = ("links", "photons", "seconds_cpu")

    def __init__(self, options, make_plain_filter):
        super().__init__(options)
        self.make_plain_filter = make_plain_filter
        self.kind = find_class("vtkSubsurfaceScattering")
        monte_carlo = {"Model": self.kind.MODEL_MONTE_CARLO}
        # Monte Carlo first: it is the reference as well, and tells where the body is not closed.
        self.methods = [
            make_method("MonteCarlo", "TargetError", options.target_errors, monte_carlo)]
        # All pairs of patches, so that tolerances are what links are off by.
        self.methods += [make_method(name, "LinkTolerance", options.link_tolerances,
                                     {"Model": number, "LinkMethod": self.kind.LINK_METHOD_DENSE})
                         for name, number in self.find_models() if name != "MonteCarlo"]
        self.reference = Method("MonteCarlo", "TargetError", [options.reference_error], monte_carlo)
        self.seeds = 0

    def find_models(self):
        """Names and numbers of those that were chosen."""
        numbers = find_choices(self.kind, "MODEL_")
        chosen = [numbers[name] for name in self.options.models or numbers]
        return sorted((pair for pair in find_constants(self.kind, "MODEL_").items()
                       if pair[1] in chosen), key=lambda pair: pair[1])

    def make_filter(self, method, tolerance):
        """Each has photons of its own: nothing is like the reference by chance, and no table of an
        earlier run shortens the next one."""
        scattering = super().make_filter(method, tolerance)
        scattering.SetSeed(scattering.GetSeed() + self.seeds)
        self.seeds += 1
        return scattering

    def describe(self, method, result, note):
        return {
            "links": whole(find_summary(result, "NumberOfLinks")),
            "photons": whole(find_summary(result, "PhotonsTraced")),
            "error_stated": find_stated(result),
        }

    def compare(self, solution, reference):
        """Errors of patches are signed, all bands together, relative to the mean of the
        reference."""
        areas = solution.get_areas()
        values, exact = solution.get(self.ARRAY), reference.get(self.ARRAY)
        difference = Difference(values, exact, find_errors(reference), areas)
        band = int(difference.bands.argmax())
        low, high = difference.find_range()
        solution.row.update(
            error_l2=difference.error, error_l2_low=low, error_l2_high=high,
            error_worst_band=float(difference.bands[band]), worst_band=BANDS[band % len(BANDS)],
            error_reference=difference.noise,
            ratio_total=float((areas @ values).sum() / ((areas @ exact).sum() or 1.0)))
        solution.row["ratio_total_error"] = solution.row["ratio_total"] * math.hypot(
            find_error_of_total(solution.surface), find_error_of_total(reference.surface))
        mean = (areas @ exact).sum() / areas.sum()
        return (values - exact).sum(axis=1) / (mean or 1.0)

    def rank(self, row):
        """What models themselves do is seen best where links are right."""
        return row["patches"], -row["tolerance"]

    def make_terms(self):
        return describe_body(self.make_plain_filter())

    def explain(self, page, rows):
        page.add_paragraph(
            "Errors are differences from Monte Carlo in the same body, on the same patches. L2 is "
            "the root mean square over area and bands, relative to that of the reference; the "
            "reference's own error of chance (\"MC error\", the same measure) is taken off, and "
            "\"from\" and \"to\" are what chance leaves open: two standard errors to both sides. "
            "An error that is not told from 0 begins at 0. The worst band is that with the "
            "largest L2 error of its own. \"Total\" is all that leaves the body over that of the "
            "reference, with one standard error. \"Stated\" is what the filter says itself: of "
            "Monte Carlo its standard error, of the models the bound on what their links may be "
            "off by, which knows nothing of the model.")
        page.add_paragraph(
            "Tolerances are TargetError of Monte Carlo and LinkTolerance of the models. Seconds of "
            "Tabulated hold those of its tables, which a process makes once for each material.")
        page.add_paragraph(
            "Monte Carlo and Tabulated take light as diffuse, with a cosine outside and "
            "refracted; the other models are of light along the normal, and a part of their error "
            "is that difference.")

    def draw_errors(self, file, surface, errors, shown, look):
        from vtklighttransport.report.figures import draw_signed
        high = numpy.quantile(numpy.concatenate([abs(own) for own in shown]), SHOWN)
        draw_signed(file, surface, errors, float(high) or 1.0, look)

    def caption_errors(self, row, errors, place):
        return ("All bands together, less the reference, relative to its mean: blue where it is "
                f"too dark, red where it is too bright; largest at ({place}), "
                f"{float(errors[abs(errors).argmax()]):+.2f}. Chance moves patches of the "
                f"reference by {row['error_reference']:.1e} (root mean square).")


@dataclasses.dataclass
class Difference:
    """How far values are from a reference that has standard errors: root mean squares over the
    surface, relative to that of the reference."""

    values: numpy.ndarray
    exact: numpy.ndarray
    errors: numpy.ndarray
    areas: numpy.ndarray

    def __post_init__(self):
        squares = self.areas @ self.exact ** 2
        excess = self.areas @ ((self.values - self.exact) ** 2 - self.errors ** 2)
        self.square = squares.sum() or 1.0
        self.excess = excess.sum() / self.square
        self.error = root(self.excess)
        self.bands = numpy.array([root(of_band / (square or 1.0))
                                  for of_band, square in zip(excess, squares)])
        self.noise = root((self.areas @ self.errors ** 2).sum() / self.square)

    def find_range(self):
        """As far as chance allows. Bands of a patch share their photons: their errors add up."""
        mixed = (abs(self.values - self.exact) * self.errors).sum(axis=1)
        own = (self.errors ** 2).sum(axis=1)
        variance = (self.areas ** 2 * (4.0 * mixed ** 2 + 2.0 * own ** 2)).sum() / self.square ** 2
        reach = RANGE * math.sqrt(variance)
        return root(self.excess - reach), root(self.excess + reach)


def root(value):
    return math.sqrt(max(float(value), 0.0))


def make_method(name, tolerance, values, settings):
    return Method(name, tolerance, sorted(values, reverse=True), settings)


def describe_body(scattering):
    """Terms of the page on the material and the scale."""
    reduced, absorption, index = find_material(scattering)
    return {
        "Material": f"{scattering.GetMaterialName(scattering.GetMaterial())}: reduced "
                    f"scattering {print_bands(reduced)} and absorption "
                    f"{print_bands(absorption)} per mm (red, green, blue), index {index:g}",
        "Scale": f"{scattering.GetMillimetersPerUnit():g} mm per unit of the mesh",
    }


def print_bands(values):
    return ", ".join(f"{value:g}" for value in values)


def find_errors(solution):
    """Standard errors of patches; 0 where the method has none."""
    name = Scattering.ARRAY + "Error"
    return solution.get(name) if solution.has(name) else numpy.zeros_like(
        solution.get(Scattering.ARRAY))


def find_bands(surface, name):
    """The field data array, None where there is none."""
    array = surface.GetFieldData().GetArray(name)
    return None if array is None else vtk_to_numpy(array).ravel()


def find_stated(surface):
    """The worst band of the first that is there."""
    for name in ("RelativeError", "LinkErrorBound", "LinkError"):
        values = find_bands(surface, name)
        if values is not None:
            return float(values.max())
    return ""


def find_error_of_total(surface):
    """Standard error of all that leaves, relative; 0 where there is nothing of chance."""
    errors = find_bands(surface, "LeavingShareError")
    if errors is None:
        return 0.0
    entering = find_bands(surface, "EnteringFlux")
    leaving = entering @ find_bands(surface, "LeavingShare")
    return float(entering @ errors / (leaving or 1.0))
