# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Whether a matrix of view factors can be right, and the change that makes it so."""

import dataclasses

import numpy

SWEEPS = 10000


@dataclasses.dataclass
class Verdict:
    """What a matrix breaks, and where the worst of it is; print it.

    All numbers are fractions of what leaves a patch: view factors, and sums of them.
    """

    count: int
    tolerance: float
    not_finite: int             # entries
    negative: int               # entries below -tolerance / count
    lowest: float               # the smallest entry
    highest: float              # the largest one
    row_excess: float           # the most by which a row, sky and back faces sum to more than 1
    row_missing: float          # the most that is missing to 1
    worst_row: int              # of these two
    reciprocity: float          # largest sum over j of |F_ij - A_j F_ji / A_i|; NaN without areas
    worst_pair: tuple           # i, j

    @property
    def in_bounds(self):
        return not (self.not_finite or self.negative or self.highest > 1.0 + self.tolerance)

    @property
    def reciprocal(self):
        """True also where no areas tell."""
        return not self.reciprocity > self.tolerance

    @property
    def closed(self):
        """Whether rows sum to 1; of an open scene only where its sky is among the rows."""
        return max(self.row_excess, self.row_missing) <= self.tolerance

    @property
    def ok(self):
        """What is missing in rows may leave through openings; all else is wrong."""
        return self.in_bounds and self.reciprocal and self.row_excess <= self.tolerance

    def __str__(self):
        lines = [f"{self.count} patches, checked to {self.tolerance:g}: "
                 + ("right" if self.ok else "WRONG")]
        if self.not_finite:
            lines.append(f"entries: {self.not_finite} are not finite; compute them anew")
            return "\n".join(lines)
        lines.append(f"entries: from {self.lowest:.3g} to {self.highest:.6g}"
                     + (f"; {self.negative} are negative" if self.negative else ""))
        lines.append(f"row sums: at most {self.row_excess:.2g} above 1, {self.row_missing:.2g} "
                     f"below (worst in row {self.worst_row})")
        if numpy.isnan(self.reciprocity):
            lines.append("reciprocity: not known, give the areas of the patches")
        else:
            lines.append(f"reciprocity: rows off by {self.reciprocity:.2g} at most (worst pair "
                         f"{self.worst_pair[0]}, {self.worst_pair[1]})")
        if not self.ok:
            lines.append("repaired() makes the smallest changes that mend it"
                         if not numpy.isnan(self.reciprocity) else "with areas it can be repaired")
        elif not self.closed:
            lines.append("what is missing leaves through openings; of a closed scene, "
                         "repaired(closed=True) divides it")
        return "\n".join(lines)


def judge(factors, areas, open_part, tolerance):
    """Of a dense or a sparse matrix; areas or None; what leaves each patch otherwise."""
    entries = factors.data if is_sparse(factors) else factors
    if not numpy.isfinite(entries).all():
        return Verdict(factors.shape[0], tolerance, int((~numpy.isfinite(entries)).sum()), 0,
                       *[numpy.nan] * 4, -1, numpy.nan, (-1, -1))
    sums = sum_rows(factors) + open_part
    worst = int(numpy.argmax(abs(sums - 1.0))) if len(sums) else -1
    gap, pair = find_gap(factors, areas)
    return Verdict(
        count=factors.shape[0], tolerance=tolerance, not_finite=0,
        negative=int((entries < -tolerance / max(len(sums), 1)).sum()),
        lowest=float(entries.min(initial=0.0)), highest=float(entries.max(initial=0.0)),
        row_excess=float((sums - 1.0).max(initial=0.0)),
        row_missing=float((1.0 - sums).max(initial=0.0)), worst_row=worst,
        reciprocity=gap, worst_pair=pair)


def find_gap(factors, areas):
    """How far the rows are from reciprocity, and the pair that is off most."""
    if areas is None:
        return numpy.nan, (-1, -1)
    exchange = scale_rows(factors, areas)
    gaps = abs(scale_rows(exchange - exchange.T, invert(areas)))
    if not len(areas):
        return 0.0, (-1, -1)
    pair = numpy.unravel_index(int(gaps.argmax()), factors.shape)
    return float(sum_rows(gaps).max()), (int(pair[0]), int(pair[1]))


def repair(factors, areas, open_part, closed):
    """Reciprocal, never negative, rows as they must be; ValueError where nothing can be done.

    The exchange is the mean of both directions; then patches are scaled, each with one number for
    its row and its column, so that what is zero stays so (Sinkhorn and Knopp 1967).
    """
    entries = factors.data if is_sparse(factors) else factors
    if not numpy.isfinite(entries).all():
        raise ValueError("entries that are not finite cannot be repaired: compute them anew")
    exchange = scale_rows(factors, areas)
    exchange = 0.5 * (exchange + exchange.T)
    exchange = exchange.maximum(0.0) if is_sparse(exchange) else numpy.maximum(exchange, 0.0)
    wanted = areas * (1.0 - open_part)
    weights = numpy.ones_like(areas)
    for _ in range(SWEEPS):
        sums = weights * (exchange @ weights)
        step = numpy.divide(wanted, sums, out=numpy.ones_like(sums), where=sums > 0.0)
        if not closed:
            step = numpy.minimum(step, 1.0)
        if not len(step) or abs(step - 1.0).max() < 1e-12:
            break
        weights *= numpy.sqrt(step)
    return scale_rows(scale_rows((scale_rows(exchange, weights)).T, weights).T, invert(areas))


def is_sparse(factors):
    return not isinstance(factors, numpy.ndarray)


def sum_rows(factors):
    return numpy.asarray(factors.sum(axis=1)).ravel()


def invert(areas):
    return numpy.divide(1.0, areas, out=numpy.zeros_like(areas), where=areas > 0.0)


def scale_rows(factors, weights):
    return factors.multiply(weights[:, None]).tocsr() if is_sparse(factors) \
        else factors * weights[:, None]
