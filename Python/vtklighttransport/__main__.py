# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The filters from the shell: python3 -m vtklighttransport radiosity|scatter in.vtp out.vtp

and what they cost: python3 -m vtklighttransport report scene.vtp folder

Exit codes: 0 done, 1 reading, computing or writing failed (no result was written), 2 wrong usage,
130 interrupted (a report of what was measured until then is there).
"""

import argparse
import os
import re
import sys

import vtklighttransport as lt
from vtklighttransport.shell import (
    READERS, Failure, Messages, Stage, choose_arrays, find_choices, find_class, get_summary, read)
from vtkmodules.vtkCommonCore import reference


def parse_numbers(text):
    try:
        return [float(part) for part in text.split(",")]
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"'{text}' is no list of numbers") from error


# Options that set a property: flag, property, kind, help. The kind is a type, a number of values of
# that type, parse_numbers for any number of values that are added one by one, True or False for a
# switch that sets it so, or the prefix of the class constants that are its choices. Defaults come
# from the class.
MESHER = (
    ("--mesh", "TargetEdgeLength", float,
     "remesh to patches of this edge length first, in the mesh's unit; 0 = diagonal / 50"),
)
IRRADIANCE = (
    ("--no-shadows", "Shadows", False, "let lights shine through patches"),
)
ENCLOSURE = (
    ("--device", "Device", "DEVICE_",
     "where the links are applied; auto takes OpenGL on a real GPU"),
    ("--links", "LinkMethod", "LINK_METHOD_",
     "a link for each pair of patches, or between clusters; auto is dense up to 8,192 patches"),
    ("--link-tolerance", "LinkTolerance", float,
     "relative error of the irradiance that hierarchical links are allowed"),
    ("--by-brightness", "RefineByBrightness", True, "refine hierarchical links where light is"),
    ("--closure", "EnforceClosure", True, "make the view factors of closed scenes sum to 1"),
    ("--band-limits", "BandLimit", parse_numbers,
     "limits of spectral bands for temperatures: wavelengths in micrometres, such as 0,8,14,inf"),
    ("--background-temperature", "BackgroundTemperature", float,
     "temperature in kelvin of what is seen through the openings of the scene"),
    ("--background-radiance", "BackgroundRadiance", parse_numbers,
     "radiance that enters through them: a value, or one per band with commas between"),
)
RADIOSITY = (
    ("--solver", "Solver", "SOLVER_", "how the equation is solved; auto is conjugate gradients"),
    ("--tolerance", "Tolerance", float,
     "error bound to stop at, as a fraction of the largest radiosity"),
    ("--iterations", "MaximumNumberOfIterations", int, "iterations at most"),
    ("--view-factor-tolerance", "ViewFactorTolerance", float,
     "bound on the absolute error of each row of view factors"),
    ("--feature-angle", "FeatureAngle", float,
     "edges sharper than this keep their own point values, in degrees"),
)
SCATTERING = (
    ("--material", "Material", "MATERIAL_",
     "measured material; it wins over the three options below"),
    ("--scattering", "ScatteringCoefficient", (3, float),
     "reduced scattering coefficient of red, green and blue, per mm"),
    ("--absorption", "AbsorptionCoefficient", (3, float),
     "absorption coefficient of red, green and blue, per mm"),
    ("--refractive-index", "RefractiveIndex", float, "refractive index of the object"),
    ("--mm-per-unit", "MillimetersPerUnit", float,
     "length of the mesh's unit in millimetres; 10 for centimetres"),
    ("--incidence", "Incidence", "INCIDENCE_",
     "without a light: whether the mesh's array is diffuse irradiance or has entered the surface"),
    ("--link-tolerance", "LinkTolerance", float,
     "bound on the relative error of the links of a patch"),
    ("--device", "Device", "DEVICE_",
     "where the links are applied; auto takes OpenGL on a real GPU"),
    ("--feature-angle", "FeatureAngle", float,
     "edges sharper than this keep their own point values, in degrees"),
)
# Arrays of the input: flag, index, help.
RADIOSITY_ARRAYS = (
    ("--emission", 0, "cell array of emitted flux per area [Emission]"),
    ("--reflectance", 1, "cell array of diffuse reflectance, 0 to 1 [Reflectance]"),
    ("--temperature", 2, "cell array of temperatures in kelvin [Temperature]"),
    ("--emissivity", 3, "cell array of emissivity, 0 to 1 [Emissivity]"),
    ("--boundary-condition", 5,
     "cell array: 0 where the temperature is given, 1 where the net flux is [BoundaryCondition]"),
    ("--net-flux", 6, "cell array of given net fluxes, W/m2; 0 without one [PrescribedNetFlux]"),
)
SCATTERING_ARRAYS = (
    ("--irradiance", 0,
     "without a light: cell array of what falls in [Irradiance, or TransmittedIrradiance]"),
)


def add_properties(parser, class_name, table):
    """The options of a table; none where the class was not built."""
    kind = getattr(lt, class_name, None)
    if kind is None:
        return
    model = kind()
    for flag, name, form, text in table:
        arguments = {"dest": name, "default": None}
        if form is parse_numbers:
            parser.add_argument(flag, help=text, metavar="A,B,...", type=form, **arguments)
            continue
        default = getattr(model, "Get" + name)()
        if isinstance(form, bool):
            arguments.update(action="store_const", const=form)
        elif isinstance(form, str):
            choices = find_choices(kind, form)
            default = next(key for key, value in choices.items() if value == default)
            arguments["choices"] = sorted(choices, key=choices.get)
        elif isinstance(form, tuple):
            arguments.update(nargs=form[0], type=form[1], metavar=("R", "G", "B"))
            default = " ".join(f"{value:g}" for value in default)
        else:
            arguments.update(type=form, metavar=name.upper() if flag == "--mesh" else "VALUE")
            default = f"{default:g}"
        if flag == "--mesh":
            arguments["metavar"] = "LENGTH"
        elif not isinstance(form, bool):
            text += f" [{default}]"
        parser.add_argument(flag, help=text, **arguments)


def apply_properties(options, algorithm, table):
    for flag, name, form, _text in table:
        value = getattr(options, name)
        if value is None:
            continue
        if form is parse_numbers:
            for number in value:
                getattr(algorithm, "Add" + name)(number)
            continue
        if isinstance(form, str):
            value = find_choices(type(algorithm), form)[value]
        getattr(algorithm, "Set" + name)(*value if isinstance(form, tuple) else (value,))
        # Setters move a value into its range without a word.
        if not isinstance(form, tuple) and getattr(algorithm, "Get" + name)() != value:
            options.parser.error(f"argument {flag}: {value:g} is out of range")


def parse_vector(text, counts, form):
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in counts or not any(numbers[:3]):
        raise argparse.ArgumentTypeError(f"'{text}' is not {form}")
    return numbers


def parse_light(text):
    return parse_vector(text, (3, 4), "X,Y,Z or X,Y,Z,INTENSITY")


def parse_direction(text):
    return parse_vector(text, (3,), "X,Y,Z")


def make_light(numbers, positional):
    from vtkmodules.vtkRenderingCore import vtkLight
    light = vtkLight()
    light.SetLightTypeToSceneLight()
    light.SetPosition(numbers[:3])
    light.SetFocalPoint(0.0, 0.0, 0.0)
    light.SetIntensity(numbers[3] if len(numbers) > 3 else 1.0)
    if positional:
        light.PositionalOn()
        # Beyond 90 degrees the light has no cone.
        light.SetConeAngle(180.0)
        light.SetAttenuationValues(0.0, 0.0, 1.0)
    return light


def make_parser():
    parser = argparse.ArgumentParser(
        prog="python3 -m vtklighttransport",
        description="Light transport on the patches of a surface mesh.",
        epilog="Exit codes: 0 done, 1 failed (no result was written), 2 wrong usage, "
               "130 interrupted.")
    parser.add_argument("--version", action="version", version=lt.__version__)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    radiosity = add_filter(
        commands, "radiosity", "diffuse interreflection: B = E + rho F B",
        "Adds the arrays Radiosity, Irradiance and NetFlux (flux per unit area). The mesh has the "
        "cell arrays Emission and Reflectance, or Temperature and Emissivity; with a light "
        "Emission may be missing.")
    add_properties(radiosity, "vtkRadiosity", RADIOSITY + ENCLOSURE)
    scatter = add_filter(
        commands, "scatter", "diffuse subsurface scattering",
        "Adds the array ScatteredIrradiance (flux per unit area that leaves the surface). Give a "
        "light, or a mesh with the cell array Irradiance.")
    add_properties(scatter, "vtkSubsurfaceScattering", SCATTERING)
    report = add_report(commands)
    for command, arrays in ((radiosity, RADIOSITY_ARRAYS), (scatter, SCATTERING_ARRAYS),
                            (report, RADIOSITY_ARRAYS)):
        for flag, index, text in arrays:
            command.add_argument(flag, metavar="NAME", dest=f"array{index}", help=text)
    return parser


def add_command(commands, name, text, description):
    command = commands.add_parser(name, help=text, description=description)
    command.set_defaults(parser=command)
    command.add_argument("input", help="surface mesh: " + ", ".join(READERS))
    command.add_argument("--quiet", action="store_true", help="no progress on stderr, no summary")
    add_properties(command, "vtkPatchMesher", MESHER)
    return command


def add_filter(commands, name, text, description):
    command = add_command(commands, name, text, description)
    command.add_argument("output", help="result: .vtp")
    command.add_argument(
        "--light", metavar="X,Y,Z[,INTENSITY]", type=parse_light, action="append", default=[],
        help="light from the direction (X, Y, Z), infinitely far; INTENSITY is the irradiance "
             "facing it [1]; repeat for more")
    command.add_argument(
        "--point-light", metavar="X,Y,Z[,INTENSITY]", type=parse_light, action="append", default=[],
        help="light at a point, in the mesh's unit; irradiance facing it is INTENSITY / distance^2 "
             "[1]; repeat for more")
    add_properties(command, "vtkDirectIrradiance", IRRADIANCE)
    return command


def add_report(commands):
    command = add_command(
        commands, "report", "error of radiosity against run time",
        "Computes the radiosity of a scene by several methods, at several tolerances, on the scene "
        "as it is and subdivided, and writes report.csv, report.html and their pictures. Ctrl-C "
        "ends it with what was measured until then.")
    command.add_argument("folder", help="where the report goes; made when missing")
    command.add_argument("--solvers", type=lambda text: text.split(","), default=["auto"],
                         metavar="NAME,...",
                         help="as --solver of radiosity, each with all kinds of links [auto]")
    for flag, values, text in (
            ("--dense-tolerances", [1e-2, 1e-3], "ViewFactorTolerance of dense links"),
            ("--link-tolerances", [1e-1, 1e-2, 1e-3], "LinkTolerance of hierarchical links"),
            ("--progressive-tolerances", [1e-1, 1e-2], "Tolerance of --progressive")):
        shown = ",".join(f"{value:g}" for value in values)
        command.add_argument(flag, type=parse_numbers, default=values, metavar="VALUE,...",
                             help=f"{text} [{shown}]")
    command.add_argument("--brightness", action="store_true",
                         help="also hierarchical links that are refined where light is")
    command.add_argument("--progressive", action="store_true",
                         help="also progressive refinement on the GPU (Southwell, OpenGL)")
    for flag, kind, value, text in (
            ("--solver-tolerance", float, 1e-6, "Tolerance of the solver"),
            ("--reference-tolerance", float, 1e-4, "ViewFactorTolerance of the dense reference"),
            ("--reference-limit", int, 6000,
             "patches up to which dense links are computed; beyond, the finest result of the other "
             "methods is the reference"),
            ("--levels", int, 2, "how many times triangles are divided in four"),
            ("--repeat", int, 1, "runs of which times are the median")):
        command.add_argument(flag, type=kind, default=value, metavar="VALUE",
                             help=f"{text} [{value:g}]")
    add_properties(command, "vtkRadiosity", ENCLOSURE)
    command.add_argument("--view", metavar="X,Y,Z", type=parse_direction,
                         help="direction that pictures are seen from [where the scene is open]")
    return command


def join_negative_values(arguments):
    """`--light -1,0,0` as `--light=-1,0,0`: argparse takes what begins with - for an option."""
    joined = []
    for argument in arguments:
        if (joined and joined[-1] in ("--light", "--point-light", "--view")
                and re.match(r"-[\d.]", argument)):
            joined[-1] += "=" + argument
        else:
            joined.append(argument)
    return joined


def write(data, options, messages):
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
    unfinished = options.output + ".part"
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    writer.SetFileName(unfinished)
    # Encoded: with the libexpat1 of Debian 12's security updates VTK 9.2 cannot read raw files.
    writer.SetDataModeToBinary()
    try:
        if not writer.Write() or messages.errors:
            raise Failure(f"cannot write {options.output}")
        os.replace(unfinished, options.output)
    except OSError as error:
        raise Failure(f"cannot write {options.output}: {error.strerror}") from error
    finally:
        if os.path.exists(unfinished):
            os.remove(unfinished)


def prepare(options, messages, refractive_index):
    """The mesh, remeshed and lit as asked for."""
    data = read(options, messages)
    if options.mesh:
        data = options.mesh.run(messages, data)
    lights = [make_light(numbers, False) for numbers in options.light]
    lights += [make_light(numbers, True) for numbers in options.point_light]
    if lights:
        irradiance = find_class("vtkDirectIrradiance")()
        apply_properties(options, irradiance, IRRADIANCE)
        irradiance.SetRefractiveIndex(refractive_index)
        for light in lights:
            irradiance.AddLight(light)
        data = Stage("direct irradiance", irradiance, options.quiet).run(messages, data)
    return data


def run_radiosity(options, messages):
    radiosity = find_class("vtkRadiosity")()
    apply_properties(options, radiosity, RADIOSITY + ENCLOSURE)
    choose_arrays(options, radiosity, RADIOSITY_ARRAYS)
    data = prepare(options, messages, 1.0)
    result = Stage("radiosity", radiosity, options.quiet).run(messages, data)
    return result, (f"{get_summary(result, 'NumberOfIterations'):.0f} iterations, "
                    f"error bound {get_summary(result, 'ErrorBound'):.2g}")


def run_scatter(options, messages):
    scattering = find_class("vtkSubsurfaceScattering")()
    apply_properties(options, scattering, SCATTERING)
    index = reference(scattering.GetRefractiveIndex())
    scattering.GetMaterialProperties(scattering.GetMaterial(), [0.0] * 3, [0.0] * 3, index)
    data = prepare(options, messages, float(index))
    if options.light or options.point_light:
        if index > 1.0:
            scattering.SetIncidenceToTransmitted()
        else:
            options.array0 = "DirectIrradiance"
    choose_arrays(options, scattering, SCATTERING_ARRAYS)
    result = Stage("scattering", scattering, options.quiet).run(messages, data)
    return result, f"{get_summary(result, 'NumberOfLinks'):.0f} links"


def run_report(options, messages):
    try:
        from vtklighttransport import report
    except ImportError as error:
        raise Failure(f"a report needs numpy: {error}") from error
    data = read(options, messages)
    if options.mesh:
        data = options.mesh.run(messages, data)
    return report.run(options, messages, lambda: make_enclosure(options), data)


def make_enclosure(options):
    """A filter for the scene, without what the report chooses itself."""
    radiosity = find_class("vtkRadiosity")()
    apply_properties(options, radiosity, ENCLOSURE)
    choose_arrays(options, radiosity, RADIOSITY_ARRAYS)
    return radiosity


def check_usage(options):
    if os.path.splitext(options.input)[1].lower() not in READERS:
        options.parser.error(f"argument input: '{options.input}' is none of {', '.join(READERS)}")
    if options.command == "report":
        check_report_usage(options)
    else:
        check_output(options)
    length = getattr(options, "TargetEdgeLength", None)
    options.mesh = None
    if length is not None:
        if not 0.0 <= length < float("inf"):
            options.parser.error(f"argument --mesh: {length:g} is out of range")
        mesher = find_class("vtkPatchMesher")()
        apply_properties(options, mesher, MESHER)
        options.mesh = Stage("mesh", mesher, options.quiet)


def check_output(options):
    if os.path.splitext(options.output)[1].lower() != ".vtp":
        options.parser.error(f"argument output: '{options.output}' is not a .vtp file")
    folder = os.path.dirname(options.output)
    if folder and not os.path.isdir(folder):
        raise Failure(f"cannot write {options.output}: no such directory")


def check_report_usage(options):
    for flag, value, low, high in (
            ("--repeat", options.repeat, 1, 1000), ("--levels", options.levels, 0, 12),
            ("--reference-limit", options.reference_limit, 0, float("inf"))):
        if not low <= value <= high:
            options.parser.error(f"argument {flag}: {value:g} is out of range")
    model = make_enclosure(options)
    solvers = find_choices(type(model), "SOLVER_")
    for name in options.solvers:
        if name not in solvers:
            options.parser.error(f"argument --solvers: '{name}' is none of {', '.join(solvers)}")
    for flag, name, values in (
            ("--dense-tolerances", "ViewFactorTolerance", options.dense_tolerances),
            ("--reference-tolerance", "ViewFactorTolerance", [options.reference_tolerance]),
            ("--solver-tolerance", "Tolerance", [options.solver_tolerance]),
            ("--progressive-tolerances", "Tolerance", options.progressive_tolerances),
            ("--link-tolerances", "LinkTolerance", options.link_tolerances)):
        for value in values if hasattr(model, "Set" + name) else ():
            # Setters move a value into its range without a word.
            getattr(model, "Set" + name)(value)
            if getattr(model, "Get" + name)() != value:
                options.parser.error(f"argument {flag}: {value:g} is out of range")


def compute(options, messages):
    """A result into a file; returns a line about it."""
    result, summary = (run_radiosity if options.command == "radiosity" else run_scatter)(
        options, messages)
    write(result, options, messages)
    return (f"{options.output}: {result.GetNumberOfCells()} patches, {summary}, "
            f"{get_summary(result, 'DeviceUsed')}")


def main(arguments):
    options = make_parser().parse_args(join_negative_values(arguments))
    messages = Messages()
    try:
        check_usage(options)
        summary = (run_report if options.command == "report" else compute)(options, messages)
    except Failure as failure:
        for line in messages.errors + [str(failure)] if str(failure) else messages.errors:
            print("error: " + line, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 130
    if not options.quiet:
        print(summary)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
