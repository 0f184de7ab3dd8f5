// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/RayHitsFile.h"

#include "Shared/Attempt.h"
#include "Support/Ranks.h"
#include "ViewFactors/CheckedFile.h"
#include "ViewFactors/RayHits.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace LightTransport
{
namespace
{
using CheckedFile::Count;
using CheckedFile::Reader;
using Hit = RayHits::Hit;

constexpr CheckedFile::Format Format{ "vtkLightTransport view factor rays ", "1", "rays" };

struct Header
{
  CheckedFile::Start Begin;
  Count Fingerprint;
  Count NumberOfPatches;
  Count RaysPerPatch;
};
static_assert(sizeof(Header) == sizeof(CheckedFile::Start) + 3 * sizeof(Count),
  "a header without gaps");

constexpr Advice Remedy{ "use a machine with more", "The system gave up", "try again" };

// Hits that ranks bring together at a time.
constexpr vtkIdType HitsPerBatch = 1 << 20;

//------------------------------------------------------------------------------
// What RayHits casts.
bool IsNumberOfRays(Count rays)
{
  return rays >= RayHits::FewestRays && rays <= RayHits::MostRays && (rays & (rays - 1)) == 0;
}

//------------------------------------------------------------------------------
bool AreUsable(const std::vector<Hit>& hits, vtkIdType numberOfPatches)
{
  return std::all_of(hits.begin(), hits.end(),
    [=](Hit hit)
    { return hit < numberOfPatches && hit >= PatchRays::FromBehind(numberOfPatches - 1); });
}

//------------------------------------------------------------------------------
// The first rank has the file, and all bring what it is to write.
Outcome WriteHits(const std::string& fileName, const RayHits& hits, const Header& header,
  const Ranks& ranks)
{
  const bool writes = ranks.GetMine() == 0;
  CheckedFile::Writer file;
  Outcome written = ranks.Agree(writes ? file.Begin(fileName) : Outcome::Done());
  if (!written)
  {
    return written;
  }
  file.Put(&header, sizeof(header));
  const auto rays = static_cast<int>(header.RaysPerPatch);
  const auto patches = static_cast<vtkIdType>(header.NumberOfPatches);
  const vtkIdType step = std::max<vtkIdType>(HitsPerBatch / rays, 1);
  for (vtkIdType begin = 0; begin < patches; begin += step)
  {
    std::vector<Hit> mine;
    const vtkIdType last = std::min(begin + step, hits.GetLast());
    for (vtkIdType patch = std::max(begin, hits.GetFirst()); patch < last; ++patch)
    {
      hits.Visit(patch, 0, rays, [&mine](Hit hit) { mine.push_back(hit); });
    }
    const std::vector<Hit> all = ranks.Gather(mine);
    if (writes)
    {
      file.PutValues(all);
    }
  }
  return ranks.Agree(writes ? file.Finish() : Outcome::Done());
}

//------------------------------------------------------------------------------
// Before anything is allocated: the file is as long as what it announces, and there is the memory.
Outcome CheckSizes(const Reader& file, const Header& header, const Ranks& ranks)
{
  const Count patches = header.NumberOfPatches;
  const Count rays = header.RaysPerPatch;
  if (!IsNumberOfRays(rays) || patches > static_cast<Count>(std::numeric_limits<Hit>::max()))
  {
    return Reader::FailDamaged();
  }
  Outcome good = file.ExpectLast(patches * rays * sizeof(Hit));
  return good ? Reader::CheckMemory(RayHits::GetEstimatedBytes(static_cast<vtkIdType>(patches),
                  { static_cast<int>(rays), {} }, ranks))
              : good;
}

//------------------------------------------------------------------------------
Outcome ReadHits(const std::string& fileName, const Ranks& ranks, RayHits& hits, Header& header)
{
  Reader file;
  Outcome got = file.Open(fileName);
  got = got ? file.GetHead(Format, header) : got;
  got = got ? CheckSizes(file, header, ranks) : got;
  if (!got)
  {
    return got;
  }
  const auto patches = static_cast<vtkIdType>(header.NumberOfPatches);
  const auto rays = static_cast<int>(header.RaysPerPatch);
  auto next = hits.Reset(header.Fingerprint, patches, rays, ranks).begin();
  std::vector<Hit> met(rays);
  for (vtkIdType patch = 0; patch < patches; ++patch)
  {
    if (got = file.Get(met.data(), met.size() * sizeof(Hit)); !got)
    {
      return got;
    }
    if (!AreUsable(met, patches))
    {
      return Reader::Fail("its rays meet patches that are not there.");
    }
    if (patch >= hits.GetFirst() && patch < hits.GetLast())
    {
      next = std::copy(met.begin(), met.end(), next);
    }
  }
  return file.GetChecksum();
}
} // namespace

//------------------------------------------------------------------------------
Outcome RayHitsFile::Write(const std::string& fileName, const RayHits& hits,
  vtkIdType numberOfPatches, int raysPerPatch, const Ranks& ranks)
{
  const Header header{ CheckedFile::Writer::MakeStart(Format), hits.GetFingerprint(),
    static_cast<Count>(numberOfPatches), static_cast<Count>(raysPerPatch) };
  Outcome written =
    ranks.Attempt([&]() { return WriteHits(fileName, hits, header, ranks); }, Remedy);
  return written
    ? written
    : Outcome::Failed("\"" + fileName + "\" cannot be written: " + written.GetMessage() + ".");
}

//------------------------------------------------------------------------------
bool RayHitsFile::Is(const std::string& fileName)
{
  return Reader::IsOf(fileName, Format);
}

//------------------------------------------------------------------------------
Outcome RayHitsFile::Read(const std::string& fileName, const Ranks& ranks, RayHits& hits,
  int& raysPerPatch)
{
  RayHits loaded;
  Header header;
  Outcome read = ranks.Attempt([&]() { return ReadHits(fileName, ranks, loaded, header); }, Remedy);
  if (!read)
  {
    return Outcome::Failed(
      "No view factors can be read from \"" + fileName + "\": " + read.GetMessage());
  }
  hits = std::move(loaded);
  raysPerPatch = static_cast<int>(header.RaysPerPatch);
  return read;
}
} // namespace LightTransport
