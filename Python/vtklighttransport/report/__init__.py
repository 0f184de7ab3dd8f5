# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The report of a scene: error against run time, for methods x tolerances x sizes.

subject           what a report is of: its methods, what it tells of each
radiosity         ... ways to link patches, beside dense links
scattering        ... models of subsurface scattering, beside Monte Carlo
scattering_links  ... ways to link patches of one of them, beside all pairs
study             goes through methods, tolerances and sizes
record            what has been measured: the rows of report.csv, what was left out
page              report.html
html              a page from top to bottom: paragraphs, tables, figures
figures           its plots and pictures

Needs numpy.
"""

import os
import sys

from vtklighttransport.report.page import write_page
from vtklighttransport.report.record import Record
from vtklighttransport.report.study import Study
from vtklighttransport.shell.interrupts import tidying_up
from vtklighttransport.shell.stages import Failure, Summary


@tidying_up()
def run(options, messages, subject, surface):
    """Measures, then writes the page, also of what an interrupted run has measured."""
    record = Record(options.folder, subject.COLUMNS, options.quiet or options.json)
    try:
        os.makedirs(options.folder, exist_ok=True)
        try:
            Study(options, messages, record, subject).run(surface)
        except KeyboardInterrupt:
            if not record.rows:
                raise
            record.interrupted = True
            print("interrupted: the page shows what was measured so far", file=sys.stderr)
        write_page(options, messages, record, subject)
    except FileExistsError as error:
        raise Failure(f"cannot write {options.folder}: it is a file, not a folder") from error
    except OSError as error:
        name = error.filename or options.folder
        raise Failure(f"cannot write {name}: {error.strerror}") from error
    if record.interrupted:
        raise KeyboardInterrupt
    page = os.path.join(options.folder, "report.html")
    return Summary(f"{page}: {len(record.rows)} rows", {"output": page, "rows": len(record.rows)})
