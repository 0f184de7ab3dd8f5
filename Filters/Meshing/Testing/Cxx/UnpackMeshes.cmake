# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
# Unpacks meshes for tests into FOLDER: some of those in ARCHIVE, the data of CGAL's demos, and DRAGON, a file that gzip made.
file(MAKE_DIRECTORY "${FOLDER}")
if (ARCHIVE)
  file(ARCHIVE_EXTRACT INPUT "${ARCHIVE}" DESTINATION "${FOLDER}" PATTERNS "data/meshes/*.off")
endif ()
get_filename_component(name "${DRAGON}" NAME_WLE)
execute_process(COMMAND "${GZIP}" -dc "${DRAGON}"
  OUTPUT_FILE "${FOLDER}/${name}"
  RESULT_VARIABLE failed)
if (failed)
  message(FATAL_ERROR "gzip could not unpack ${DRAGON}: ${failed}")
endif ()
