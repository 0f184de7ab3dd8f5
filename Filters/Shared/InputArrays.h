// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What every filter asks of the arrays of its input, whatever they are for: VTK copies and reads
/// beyond the end of those that are too short.
#ifndef InputArrays_h
#define InputArrays_h

#include "Shared/Outcome.h"
#include "vtkAbstractArray.h"
#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

namespace LightTransport
{
namespace InputArrays
{
//------------------------------------------------------------------------------
/// The array that a user has chosen for one of a filter's inputs, or `defaultName`.
/// vtkAlgorithm::GetInputArrayInformation would make what is not there: VTK's garbage collector
/// then takes memory, and ends the process where it gets none.
inline std::string GetChosenName(vtkAlgorithm* filter, int index, const char* defaultName)
{
  vtkInformationVector* arrays =
    filter->GetInformation()->Get(vtkAlgorithm::INPUT_ARRAYS_TO_PROCESS());
  const bool isChosen = arrays && index < arrays->GetNumberOfInformationObjects();
  const char* name =
    isChosen ? arrays->GetInformationObject(index)->Get(vtkDataObject::FIELD_NAME()) : nullptr;
  return name && *name ? name : defaultName;
}

//------------------------------------------------------------------------------
/// What is wrong with the lengths of arrays of `kind` ("cell"), of which `count` are needed; empty
/// where nothing is.
inline std::string DescribeLengths(vtkDataSetAttributes* data, vtkIdType count,
  const std::string& kind)
{
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    vtkAbstractArray* array = data->GetAbstractArray(index);
    if (array && array->GetNumberOfTuples() != count)
    {
      std::ostringstream text;
      text << "the " << kind << " array \"" << (array->GetName() ? array->GetName() : "")
           << "\" has " << array->GetNumberOfTuples() << " tuples where there are " << count << ' '
           << kind << "s: give it one for each " << kind << ", or remove it";
      return text.str();
    }
  }
  return {};
}

//------------------------------------------------------------------------------
/// What is wrong with the lengths of the arrays of a data set; empty where nothing is.
inline std::string DescribeLengths(vtkDataSet* data)
{
  const std::string cells = DescribeLengths(data->GetCellData(), data->GetNumberOfCells(), "cell");
  return cells.empty() ? DescribeLengths(data->GetPointData(), data->GetNumberOfPoints(), "point")
                       : cells;
}

//------------------------------------------------------------------------------
/// Fails where a cell or point array has more or fewer tuples than there are cells or points.
inline Outcome CheckLengths(vtkDataSet* data)
{
  const std::string problem = DescribeLengths(data);
  return problem.empty() ? Outcome::Done() : Outcome::Failed("In the input " + problem + ".");
}

//------------------------------------------------------------------------------
/// How many letters have to be put in, taken out or replaced to make one name of the other, capital
/// or not (Levenshtein 1966).
inline std::size_t GetDistance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      const bool same = std::tolower(static_cast<unsigned char>(a[i])) ==
        std::tolower(static_cast<unsigned char>(b[j]));
      const std::size_t replaced = diagonal + (same ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({ replaced, diagonal + 1, row[j] + 1 });
    }
  }
  return row.back();
}

//------------------------------------------------------------------------------
/// For a name that is not there, the one that may be meant: " There is "Emission1": did you mean
/// it?"; empty where there is none.
inline std::string Suggest(vtkFieldData* data, const std::string& name)
{
  std::string nearest;
  std::size_t least = 1 + std::min<std::size_t>(2, name.size() / 3);
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    const char* other = data->GetAbstractArray(index)->GetName();
    const std::size_t distance = other ? GetDistance(name, other) : least;
    if (distance < least && name != other)
    {
      least = distance;
      nearest = other;
    }
  }
  return nearest.empty() ? nearest : " There is \"" + nearest + "\": did you mean it?";
}
} // namespace InputArrays
} // namespace LightTransport

#endif
