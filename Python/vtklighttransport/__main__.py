# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The filters from the shell: python3 -m vtklighttransport radiosity in.stl out.vtp

--help tells all commands.

What the commands are and do is in `commands`; here are the parser, exit codes and interrupts.
Exit codes: 0 done, 1 reading, computing or writing failed (no result was written), 2 wrong usage,
130 interrupted (a report of what was measured until then is there).
"""

import argparse
import json
import math
import sys

import vtklighttransport as lt
from vtklighttransport.commands import load_commands
from vtklighttransport.shell.arguments import join_negative_values, refuse_unknown
from vtklighttransport.shell.stages import Failure, Messages


def make_parser():
    parser = argparse.ArgumentParser(
        prog="python3 -m vtklighttransport",
        description="Light transport on the patches of a surface mesh.",
        epilog="Exit codes: 0 done, 1 failed (no result was written), 2 wrong usage, "
               "130 interrupted.")
    parser.add_argument("--version", action="version", version=lt.__version__)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, module in load_commands().items():
        command = commands.add_parser(name, help=module.HELP, description=module.DESCRIPTION)
        command.set_defaults(parser=command, module=module, flags={})
        command.add_argument("--quiet", action="store_true",
                             help="no progress on stderr, no summary")
        command.add_argument("--json", action="store_true",
                             help="the summary as JSON on stdout, for scripts")
        module.add_options(command)
    return parser


def main(arguments):
    options, unknown = make_parser().parse_known_args(join_negative_values(arguments))
    if unknown:
        refuse_unknown(options.parser, unknown)
    messages = Messages(options.flags)
    try:
        options.module.check(options)
        summary = options.module.run(options, messages)
    except Failure as failure:
        for line in messages.errors + [str(failure)] if str(failure) else messages.errors:
            print("error: " + line, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 130
    if options.json:
        print(print_json({"command": options.command, **summary.values,
                          "warnings": messages.warnings}))
    elif not options.quiet:
        print(summary.text)
    return 0


def print_json(values):
    """What is not finite becomes null: JSON has no such number."""
    def clean(value):
        if isinstance(value, dict):
            return {str(key): clean(part) for key, part in value.items()}
        if isinstance(value, (list, tuple)):
            return [clean(part) for part in value]
        return None if isinstance(value, float) and not math.isfinite(value) else value

    return json.dumps(clean(values), indent=2)


def run_script():
    """The command that pip makes."""
    sys.exit(main(sys.argv[1:]))


if __name__ == "__main__":
    run_script()
