// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Tracing/SceneTrees.h"

#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>

namespace LightTransport
{
//------------------------------------------------------------------------------
template <typename Condition>
void SceneTrees::Drop(const Condition& isDropped)
{
  const auto first = std::stable_partition(this->Entries.begin(), this->Entries.end(),
    [&isDropped](const std::unique_ptr<Entry>& entry) { return !isDropped(*entry); });
  std::for_each(first, this->Entries.end(),
    [this](const std::unique_ptr<Entry>& entry)
    { this->DroppedRuns += entry->Tree.GetNumberOfRuns(); });
  this->Entries.erase(first, this->Entries.end());
}

//------------------------------------------------------------------------------
SceneTrees::Entry& SceneTrees::Get(vtkRenderer* renderer)
{
  this->Drop([](const Entry& entry) { return !entry.Renderer || !entry.Window; });
  const auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
    [renderer](const std::unique_ptr<Entry>& entry) { return entry->Renderer == renderer; });
  if (found != this->Entries.end())
  {
    (*found)->Window = renderer->GetRenderWindow();
    return **found;
  }
  this->Entries.push_back(std::make_unique<Entry>());
  this->Entries.back()->Renderer = renderer;
  this->Entries.back()->Window = renderer->GetRenderWindow();
  return *this->Entries.back();
}

//------------------------------------------------------------------------------
vtkIdType SceneTrees::GetNumberOfRuns() const
{
  vtkIdType runs = this->DroppedRuns;
  for (const auto& entry : this->Entries)
  {
    runs += entry->Tree.GetNumberOfRuns();
  }
  return runs;
}

//------------------------------------------------------------------------------
void SceneTrees::Release(vtkWindow* window)
{
  this->Drop([window](const Entry& entry) { return !window || entry.Window == window; });
}
} // namespace LightTransport
