# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The commands of the shell. Each is a module of this folder and has

HELP                    its line in the list of commands
DESCRIPTION             what its own --help begins with
add_options(parser)     its arguments; --quiet is there
check(options)          wrong usage goes to options.parser.error, other hindrances raise Failure;
                        nothing is read, computed or written yet
run(options, messages)  does it; returns a Summary, whose text is printed unless --quiet
"""

import importlib

# In the order of the list of commands; `view_factors` is the command view-factors.
MODULES = ("radiosity", "scatter", "view_factors", "mesh", "atlas", "exr_info", "report")


def load_commands():
    """The modules by the names of their commands."""
    return {module.replace("_", "-"): importlib.import_module(f"{__name__}.{module}")
            for module in MODULES}
