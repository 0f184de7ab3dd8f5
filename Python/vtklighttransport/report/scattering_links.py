# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The report of subsurface scattering: ways to link patches, beside all pairs."""

from vtklighttransport.arrays import relative_error
from vtklighttransport.report.scattering import describe_body, find_stated
from vtklighttransport.report.subject import (
    FIRST_COLUMNS, LAST_COLUMNS, Method, Subject, whole)
from vtklighttransport.shell.properties import find_class
from vtklighttransport.summaries import find_summary, get_summary

# What LinkTolerance 0 is for all pairs.
REFERENCE_TOLERANCE = 1e-4
# More than tolerances ask for: they alone limit links.
MOST_LINKS = 65536


class ScatteringLinks(Subject):
    TITLE = "Links of subsurface scattering"
    QUANTITY = "scattered irradiance"
    ARRAY = "ScatteredIrradiance"
    COLUMNS = {
        **FIRST_COLUMNS,
        "seconds_links": ("links s", ">8", ".3g"),
        "seconds_apply": ("apply s", ">8", ".2g"),
        "links": ("links", ">12", ",d"),
        "links_per_receiver": ("a patch", ">8", ".4g"),
        "bytes": ("bytes", ">8", ".1e"),
        "error_l2": ("L2 error", ">9", ".2%"),
        "error_max": ("max error", ">9", ".2%"),
        "error_stated": ("stated", ">8", ".2%"),
        "error_compression": ("coded", ">8", ".2%"),
        **LAST_COLUMNS,
    }
    TIME = ("seconds_cpu", "CPU seconds")
    GROWTH = (("growth_links.png", "links", "Links"),
              ("growth_seconds.png", "seconds_links", "Seconds for the links"))
    EXPONENTS = ("links", "bytes", "seconds_links", "seconds_apply")

    def __init__(self, options, make_plain_filter):
        super().__init__(options)
        self.make_plain_filter = make_plain_filter
        kind = find_class("vtkSubsurfaceScattering")
        dense = {"LinkMethod": kind.LINK_METHOD_DENSE}
        uniform = {"LinkMethod": kind.LINK_METHOD_UNIFORM}
        adaptive = {"LinkMethod": kind.LINK_METHOD_ADAPTIVE, "NumberOfLinks": MOST_LINKS}
        coded = {"CompressLinks": True}
        tolerances = sorted(options.link_tolerances, reverse=True)
        numbers = sorted(options.numbers_of_links)
        self.methods = [
            Method("AllPairs", "LinkTolerance", tolerances, dense),
            Method("Uniform", "NumberOfLinks", numbers, uniform),
            Method("UniformCompressed", "NumberOfLinks", numbers, uniform | coded),
            Method("Adaptive", "LinkTolerance", tolerances, adaptive),
            Method("AdaptiveCompressed", "LinkTolerance", tolerances, adaptive | coded),
            Method("AdaptiveForLight", "LinkTolerance", tolerances,
                   adaptive | {"RefineByIrradiance": True})]
        self.reference = Method("AllPairs", "LinkTolerance", [REFERENCE_TOLERANCE], dense)

    def describe(self, method, result, note):
        compression = find_summary(result, "CompressionError")
        return {
            "seconds_links": get_summary(result, "LinkSeconds"),
            "seconds_apply": get_summary(result, "ApplySeconds"),
            "links": whole(get_summary(result, "NumberOfLinks")),
            "links_per_receiver": get_summary(result, "LinksPerReceiver"),
            "bytes": whole(get_summary(result, "LinkBytes")),
            "error_stated": find_stated(result),
            "error_compression": "" if compression is None else compression,
        }

    def compare(self, solution, reference):
        """Errors of patches are relative to the largest scattered irradiance."""
        exact = reference.get(self.ARRAY)
        errors = abs(solution.get(self.ARRAY) - exact).max(axis=1) / (abs(exact).max() or 1.0)
        solution.row.update(
            error_l2=relative_error(solution.get(self.ARRAY), exact, solution.get_areas()),
            error_max=float(errors.max()))
        return errors

    def rank(self, row):
        """Where links are wrong is seen best where there are few."""
        return row["patches"], row["error_l2"]

    def make_terms(self):
        return describe_body(self.make_plain_filter())

    def explain(self, page, rows):
        page.add_paragraph(
            f"Errors are differences from all pairs of patches at LinkTolerance "
            f"{REFERENCE_TOLERANCE:g}, on the same patches: they tell what links cost, and nothing "
            "of the model. L2 is the root mean square over area and bands, relative to that of "
            "the reference; the largest error is relative to the largest scattered irradiance. "
            "\"Stated\" is what the filter says itself: of all pairs a bound, of links from "
            "clusters what is expected of light that differs within them, of those for the "
            "light that is there (RefineByIrradiance) what a sample of patches misses of it. "
            "\"Coded\" is what a code book of 256 entries adds to the links.")
        page.add_paragraph(
            "Tolerances are LinkTolerance; of uniform links they are NumberOfLinks, the clusters "
            "that all patches share. \"A patch\" is the number of links of each on average.")

    def draw_errors(self, file, surface, errors, shown, look):
        from vtklighttransport.report.figures import draw_magnitudes
        draw_magnitudes(file, surface, errors, look)

    def caption_errors(self, row, errors, place):
        return (f"It is largest, {errors.max():.1e} of the largest scattered irradiance, on patch "
                f"{int(errors.argmax())} at ({place}).")
