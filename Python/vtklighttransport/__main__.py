# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The filters from the shell: python3 -m vtklighttransport radiosity|scatter in.vtp out.vtp

and what they cost: python3 -m vtklighttransport report scene.vtp folder

What the commands are and do is in `commands`; here are the parser, exit codes and interrupts.
Exit codes: 0 done, 1 reading, computing or writing failed (no result was written), 2 wrong usage,
130 interrupted (a report of what was measured until then is there).
"""

import argparse
import sys

import vtklighttransport as lt
from vtklighttransport.commands import load_commands
from vtklighttransport.shell.arguments import join_negative_values
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
        command.set_defaults(parser=command, module=module)
        command.add_argument("--quiet", action="store_true",
                             help="no progress on stderr, no summary")
        module.add_options(command)
    return parser


def main(arguments):
    options = make_parser().parse_args(join_negative_values(arguments))
    messages = Messages()
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
    if not options.quiet:
        print(summary)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
