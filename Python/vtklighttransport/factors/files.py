# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Matrices in files of NumPy and in tables. What is read are the arguments of ViewFactorMatrix."""

import io
import zipfile

import numpy

COLUMNS = ("areas", "sky", "back_faces", "errors")
# Of the columns of a table, in this order; view factors follow.
TITLES = ("Patch", "Area", "Sky", "BackFace", "Error")


def pack(matrix):
    """The bytes of an .npz."""
    arrays = {name: getattr(matrix, name) for name in COLUMNS if getattr(matrix, name) is not None}
    if matrix.is_sparse:
        # As scipy.sparse.save_npz names them.
        arrays.update(format=numpy.array(b"csr"), shape=numpy.array(matrix.factors.shape),
                      data=matrix.factors.data, indices=matrix.factors.indices,
                      indptr=matrix.factors.indptr)
    else:
        arrays["factors"] = matrix.factors
    stream = io.BytesIO()
    numpy.savez_compressed(stream, **arrays)
    return stream.getvalue()


def print_table(matrix):
    columns = [numpy.arange(len(matrix))]
    columns += [numpy.full(len(matrix), numpy.nan) if matrix.areas is None else matrix.areas,
                matrix.sky, matrix.back_faces, matrix.errors]
    lines = [",".join([*TITLES, *map(str, range(len(matrix)))])]
    for i, head in enumerate(zip(*columns)):
        row = matrix.factors[i]
        row = row.toarray().ravel() if matrix.is_sparse else row
        lines.append(",".join([str(head[0]), *(f"{value:.9g}" for value in (*head[1:], *row))]))
    return "\n".join(lines) + "\n"


def print_pairs(matrix):
    lines = ["From,To,ViewFactor"]
    for i in range(len(matrix)):
        row = matrix.factors[i]
        row = row.toarray().ravel() if matrix.is_sparse else row
        lines += [f"{i},{j},{row[j]:.9g}" for j in numpy.flatnonzero(row)]
    return "\n".join(lines) + "\n"


def read(file):
    with open(file, "rb") as stream:
        start = stream.read(6)
    if start[:2] == b"PK":
        return read_npz(file)
    if start == b"\x93NUMPY":
        return {"factors": load(file)}
    return read_table(file)


def load(file):
    """Never what would run code."""
    try:
        return numpy.load(file, allow_pickle=False)
    except (ValueError, EOFError, OSError, zipfile.BadZipFile) as error:
        raise ValueError(
            f"{file} is damaged, or has objects other than numbers: {error}") from error


def read_npz(file):
    with load(file) as arrays:
        try:
            columns = {name: arrays[name] for name in COLUMNS if name in arrays}
            columns["factors"] = find_factors(file, arrays)
        except (ValueError, EOFError, zipfile.BadZipFile) as error:
            raise ValueError(f"{file} cannot be read: {error}") from error
    return columns


def find_factors(file, arrays):
    if "indptr" in arrays:
        return make_sparse(file, arrays)
    for name in arrays:
        if name in ("factors", "F") or arrays[name].ndim == 2:
            return arrays[name]
    raise ValueError("it has neither a square array nor a matrix of scipy.sparse.save_npz; there "
                     f"are {', '.join(arrays) or 'no arrays'}")


def make_sparse(file, arrays):
    missing = {"data", "indices", "indptr", "shape"} - set(arrays)
    kind = arrays["format"].item() if "format" in arrays else b"csr"
    if missing or kind not in (b"csr", "csr"):
        raise ValueError("of sparse matrices CSR is read: data, indices, indptr, shape and the "
                         f"format 'csr', but the format is {kind} and {missing or 'none'} missing")
    try:
        import scipy.sparse
    except ImportError as error:
        raise ImportError(f"{file} has a sparse matrix, which needs scipy "
                          "(Debian: python3-scipy)") from error
    matrix = scipy.sparse.csr_matrix(
        (arrays["data"], arrays["indices"], arrays["indptr"]), shape=tuple(arrays["shape"]))
    # What is inconsistent would be read beyond the end of an array later on.
    matrix.check_format(full_check=True)
    return matrix


def read_table(file):
    """What `to_csv` prints, with or without its line of titles and first columns."""
    try:
        with open(file, encoding="utf-8") as stream:
            titles = stream.readline().rstrip("\n").split(",")
        if titles[:1] == ["From"]:
            raise ValueError("pairs do not tell how many patches there are: read the table")
        named = titles[:len(TITLES)] == list(TITLES)
        rows = numpy.loadtxt(file, delimiter=",", skiprows=1 if named else 0, ndmin=2)
    except (ValueError, UnicodeDecodeError) as error:
        raise ValueError(
            f"{file} is none of the forms that are read (.npz, .npy, a table of to_csv, the text "
            f"form of View3D, OpenFOAM's F): {error}") from error
    if not named:
        return {"factors": rows}
    _, areas, sky, back_faces, errors = rows[:, :len(TITLES)].T
    return {"factors": rows[:, len(TITLES):], "sky": sky, "back_faces": back_faces,
            "errors": errors, "areas": None if numpy.isnan(areas).any() else areas}
