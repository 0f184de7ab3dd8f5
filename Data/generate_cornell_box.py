#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Write cornell_box.vtp, the Cornell box from its published measurements.

Source: Cornell University Program of Computer Graphics, "Cornell Box Data"
(https://www.graphics.cornell.edu/online/box/data.html): the corners of all surfaces in millimetres,
the reflectance of the three paints from 400 to 700 nm in steps of 4 nm, and the lamp's spectrum.
The camera there stands at (278, 273, -800) and looks along +z; the box is open towards it.

What is changed, so that the surface can be meshed and no two parts of it lie on each other: the
lamp is cut out of the ceiling, the footprints of the two blocks are cut out of the floor and the
bottoms of the blocks are left out. All other points are the published ones, the left wall's four do
not lie in one plane (it is made of two triangles). All normals point into the air of the room.

Spectra become three bands, red (600 to 700 nm), green (500 to 600 nm) and blue (400 to 500 nm), by
the mean of the measured values over each band (linear between the measurements).

Cell arrays: "Region" (1 component, see REGIONS), "Reflectance" and "Emission" (3 components: red,
green, blue; emission is radiant exitance in the arbitrary unit of the lamp's spectrum).

Usage: generate_cornell_box.py [OUTPUT.vtp]    (default: cornell_box.vtp beside this script)
"""
import itertools
import math
import os
import sys

WHITE = """
.343 .445 .551 .624 .665 .687 .708 .723 .715 .710 .745 .758 .739 .767 .777 .765 .751 .745 .748
.729 .745 .757 .753 .750 .746 .747 .735 .732 .739 .734 .725 .721 .733 .725 .732 .743 .744 .748
.728 .716 .733 .726 .713 .740 .754 .764 .752 .736 .734 .741 .740 .732 .745 .755 .751 .744 .731
.733 .744 .731 .712 .708 .729 .730 .727 .707 .703 .729 .750 .760 .751 .739 .724 .730 .740 .737
"""
GREEN = """
.092 .096 .098 .097 .098 .095 .095 .097 .095 .094 .097 .098 .096 .101 .103 .104 .107 .109 .112
.115 .125 .140 .160 .187 .229 .285 .343 .390 .435 .464 .472 .476 .481 .462 .447 .441 .426 .406
.373 .347 .337 .314 .285 .277 .266 .250 .230 .207 .186 .171 .160 .148 .141 .136 .130 .126 .123
.121 .122 .119 .114 .115 .117 .117 .118 .120 .122 .128 .132 .139 .144 .146 .150 .152 .157 .159
"""
RED = """
.040 .046 .048 .053 .049 .050 .053 .055 .057 .056 .059 .057 .061 .061 .060 .062 .062 .062 .061
.062 .060 .059 .057 .058 .058 .058 .056 .055 .056 .059 .057 .055 .059 .059 .058 .059 .061 .061
.063 .063 .067 .068 .072 .080 .090 .099 .124 .154 .192 .255 .287 .349 .402 .443 .487 .513 .558
.584 .620 .606 .609 .651 .612 .610 .650 .638 .627 .620 .630 .628 .642 .639 .657 .639 .635 .642
"""
# The lamp: emission at 400, 500, 600 and 700 nm, and its own reflectance.
LAMP_SPECTRUM = "0 8 15.6 18.4"
LAMP_REFLECTANCE = ".78 .78 .78 .78"

# Corners as published, seen counter-clockwise from the air. Name: (paint, polygons).
REGIONS = {
    "floor": (WHITE, [[(552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2)]]),
    "ceiling": (WHITE, [[(556, 548.8, 0), (556, 548.8, 559.2), (0, 548.8, 559.2), (0, 548.8, 0)]]),
    "back": (WHITE, [[(549.6, 0, 559.2), (0, 0, 559.2), (0, 548.8, 559.2), (556, 548.8, 559.2)]]),
    "left (red)": (
        RED,
        [
            [(552.8, 0, 0), (549.6, 0, 559.2), (556, 548.8, 559.2)],
            [(552.8, 0, 0), (556, 548.8, 559.2), (556, 548.8, 0)],
        ],
    ),
    "right (green)": (GREEN, [[(0, 0, 559.2), (0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2)]]),
    "lamp": (
        LAMP_REFLECTANCE,
        [[(343, 548.8, 227), (343, 548.8, 332), (213, 548.8, 332), (213, 548.8, 227)]],
    ),
    "short block": (WHITE, None),
    "tall block": (WHITE, None),
}
# The tops of the blocks, (x, z), and their heights.
SHORT_BLOCK = ([(130, 65), (82, 225), (240, 272), (290, 114)], 165)
TALL_BLOCK = ([(423, 247), (265, 296), (314, 456), (472, 406)], 330)


def band_means(spectrum):
    """Mean over red, green and blue of equidistant measurements from 400 to 700 nm."""
    values = [float(value) for value in spectrum.split()]
    steps = (len(values) - 1) // 3
    means = []
    for band in (2, 1, 0):
        first = band * steps
        part = values[first:first + steps + 1]
        means.append((sum(part) - 0.5 * (part[0] + part[-1])) / steps)
    return means


def side(a, b, c):
    """Positive when c lies to the left of the line from a to b, all in the plane."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def crosses(edge, other):
    """Whether two edges have more in common than an end."""
    a, b = edge
    c, d = other
    if len({a, b, c, d}) < 4:
        return False
    return side(a, b, c) * side(a, b, d) <= 0 and side(c, d, a) * side(c, d, b) <= 0


def inside(point, loops):
    """Whether a point lies in the outer loop and in no hole (even-odd rule)."""
    odd = False
    for loop in loops:
        for a, b in zip(loop, loop[1:] + loop[:1]):
            if (a[1] > point[1]) != (b[1] > point[1]):
                x = a[0] + (point[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1])
                odd ^= x > point[0]
    return odd


def triangulate(loops):
    """Triangles of a plane polygon with holes: the shortest edges that fit, no new points."""
    points = [point for loop in loops for point in loop]
    edges = [edge for loop in loops for edge in zip(loop, loop[1:] + loop[:1])]
    for a, b in sorted(itertools.combinations(points, 2), key=lambda e: (math.dist(*e), e)):
        middle = (0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]))
        known = (a, b) in edges or (b, a) in edges
        if not known and inside(middle, loops) and not any(crosses((a, b), e) for e in edges):
            edges.append((a, b))
    known = {frozenset(edge) for edge in edges}
    triangles = []
    for a, b, c in itertools.combinations(points, 3):
        center = ((a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3)
        sides = {frozenset((a, b)), frozenset((b, c)), frozenset((c, a))}
        if sides <= known and inside(center, loops):
            triangle = (a, b, c) if side(a, b, c) > 0 else (a, c, b)
            signs = [[side(triangle[i], triangle[i - 2], p) > 0 for i in range(3)] for p in points]
            if not any(all(sign) for sign in signs):
                triangles.append(triangle)
    return triangles


def cut(polygon, holes):
    """Triangles of a horizontal polygon without its holes, with the polygon's orientation."""
    height = polygon[0][1]
    plane = [[(x, z) for x, _, z in loop] for loop in [polygon] + holes]
    # Counter-clockwise in (x, z) is seen from below.
    downwards = side(*plane[0][:3]) > 0
    return [
        [(x, height, z) for x, z in (triangle if downwards else triangle[::-1])]
        for triangle in triangulate(plane)
    ]


def block(top, height):
    """The top and the four sides of a block."""
    polygons = [[(x, height, z) for x, z in top]]
    for a, b in zip(top, top[1:] + top[:1]):
        upper = [(b[0], height, b[1]), (a[0], height, a[1])]
        polygons.append(upper + [(a[0], 0, a[1]), (b[0], 0, b[1])])
    return polygons


def make_regions():
    """Name, reflectance, emission and polygons of each region, in the order of their ids."""
    footprints = [[(x, 0, z) for x, z in top] for top, _ in (SHORT_BLOCK, TALL_BLOCK)]
    lamp = REGIONS["lamp"][1][0]
    made = {
        "floor": cut(REGIONS["floor"][1][0], footprints),
        "ceiling": cut(REGIONS["ceiling"][1][0], [lamp]),
        "short block": block(*SHORT_BLOCK),
        "tall block": block(*TALL_BLOCK),
    }
    for name, (paint, polygons) in REGIONS.items():
        emission = band_means(LAMP_SPECTRUM) if name == "lamp" else [0.0, 0.0, 0.0]
        yield name, band_means(paint), emission, made.get(name, polygons)


def data_array(kind, name, components, tuples):
    """One DataArray element in ASCII."""
    lines = "\n".join("          " + " ".join(repr(value) for value in row) for row in tuples)
    return (
        f'        <DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}"'
        f' format="ascii">\n{lines}\n        </DataArray>\n'
    )


def write(path):
    """Write the box as a VTK XML file of polygons."""
    index = {}
    polygons, regions, reflectances, emissions = [], [], [], []
    for region, (_, reflectance, emission, parts) in enumerate(make_regions()):
        for polygon in parts:
            polygons.append([index.setdefault(tuple(map(float, p)), len(index)) for p in polygon])
            regions.append([region])
            reflectances.append([round(value, 12) for value in reflectance])
            emissions.append([round(value, 12) for value in emission])
    offsets = [[offset] for offset in itertools.accumulate(map(len, polygons))]
    with open(path, "w", encoding="ascii", newline="\n") as file:
        file.write(
            '<?xml version="1.0"?>\n'
            '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian"'
            ' header_type="UInt64">\n'
            "  <PolyData>\n"
            f'    <Piece NumberOfPoints="{len(index)}" NumberOfVerts="0" NumberOfLines="0"'
            f' NumberOfStrips="0" NumberOfPolys="{len(polygons)}">\n'
            '      <CellData Scalars="Region">\n'
            + data_array("Int32", "Region", 1, regions)
            + data_array("Float64", "Reflectance", 3, reflectances)
            + data_array("Float64", "Emission", 3, emissions)
            + "      </CellData>\n      <Points>\n"
            + data_array("Float64", "Points", 3, index)
            + "      </Points>\n      <Polys>\n"
            + data_array("Int64", "connectivity", 1, polygons)
            + data_array("Int64", "offsets", 1, offsets)
            + "      </Polys>\n    </Piece>\n  </PolyData>\n</VTKFile>\n"
        )


if __name__ == "__main__":
    if len(sys.argv) > 2 or sys.argv[1:2] in (["-h"], ["--help"]):
        sys.exit(__doc__)
    default = os.path.join(os.path.dirname(os.path.abspath(__file__)), "cornell_box.vtp")
    write(sys.argv[1] if len(sys.argv) == 2 else default)
