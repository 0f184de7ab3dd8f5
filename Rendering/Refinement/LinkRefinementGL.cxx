// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/LinkRefinementGL.h"

#include "Context/OpenGLFunctions.h"
#include "Refinement/RefinementTables.h"
#include "vtkLightTransportRefinementDivideGS.h"
#include "vtkLightTransportRefinementPairVS.h"
#include "vtkLightTransportRefinementTakeGS.h"
#include "vtkLightTransportRefinementTestVS.h"

#include "vtkShaderProgram.h"

#include <algorithm>
#include <utility>

namespace LightTransport
{
namespace
{
/// Of all tables: texels of a line.
constexpr int WidthBits = 10;
constexpr int Width = 1 << WidthBits;
/// Of tables in all: what OpenGL 3.2 promises vertex shaders is 16.
constexpr int NumberOfSamplers = RefinementTables::NumberOfSlotTables + 4;
/// Floats that the geometry shader makes of a pair.
constexpr int FloatsOfFollower = 4;
constexpr int FloatsOfPart = 12;

//------------------------------------------------------------------------------
std::string Define(const std::string& shader, const std::string& defines)
{
  std::string source = shader;
  vtkShaderProgram::Substitute(source, "//VTK::LightTransport::Define", defines);
  return source;
}

//------------------------------------------------------------------------------
std::string DefineNumber(const char* name, int value)
{
  return "#define " + std::string(name) + " " + std::to_string(value) + "\n";
}
} // namespace

//------------------------------------------------------------------------------
LinkRefinementGL::LinkRefinementGL(FloatTextures& engine) : Engine(engine) {}

//------------------------------------------------------------------------------
void LinkRefinementGL::Release()
{
  for (VectorBuffer* buffer : { &this->Pairs, &this->Followers, &this->Tested, &this->Taken })
  {
    buffer->Release();
  }
  for (FeedbackPass* pass : { this->TestPass.get(), this->TakePass.get(), this->DividePass.get() })
  {
    if (pass)
    {
      pass->Release();
    }
  }
}

//------------------------------------------------------------------------------
Outcome LinkRefinementGL::Initialize(std::shared_ptr<const Body> body)
{
  this->Described = std::move(body);
  this->NumberOfTests = 0;
  const RefinementTables tables(*this->Described);
  Outcome made = this->CheckLimits(tables);
  made = made ? this->MakeTables(tables) : made;
  if (made)
  {
    this->FirstPiece = tables.GetFirstPiece();
    this->SquaredCore = tables.GetSquaredCore();
    this->LengthFactor = tables.GetLengthFactor();
    this->ValueFactor = tables.GetValueFactor();
    this->MakePasses(tables);
  }
  return made;
}

//------------------------------------------------------------------------------
Outcome LinkRefinementGL::CheckLimits(const RefinementTables& tables) const
{
  int samplers = 0;
  int vertices = 0;
  int floats = 0;
  glGetIntegerv(GL_MAX_VERTEX_TEXTURE_IMAGE_UNITS, &samplers);
  glGetIntegerv(GL_MAX_GEOMETRY_OUTPUT_VERTICES, &vertices);
  glGetIntegerv(GL_MAX_GEOMETRY_TOTAL_OUTPUT_COMPONENTS, &floats);
  if (samplers < NumberOfSamplers)
  {
    return Outcome::Failed("its vertex shaders read " + std::to_string(samplers) +
      " textures, and " + std::to_string(NumberOfSamplers) + " are needed");
  }
  const int followers = tables.GetMostChildren() + 1;
  if (followers > vertices || FloatsOfFollower * followers > floats || FloatsOfPart > floats)
  {
    return Outcome::Failed("a cluster has " + std::to_string(tables.GetMostChildren()) +
      " parts, more than its geometry shaders can make");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome LinkRefinementGL::MakeTable(Group& group, std::size_t index,
  const std::vector<float>& texels)
{
  const auto count = static_cast<vtkIdType>(texels.size() / 4);
  const int height = FloatTextures::DivideUp(count, Width);
  if (count > FloatTextures::MaximumTexels || height > this->Engine.GetMaximumTextureSize())
  {
    return Outcome::Failed(std::to_string(this->Described->Slots.size()) +
      " clusters and patches are too many for its textures");
  }
  Group table;
  if (Outcome allocated = this->Engine.Allocate(table, 1, Width, height); !allocated)
  {
    return allocated;
  }
  std::vector<float> lines(texels);
  lines.resize(std::size_t(4) * Width * height, 0.0f);
  this->Engine.UploadTable(table, lines);
  group.resize(std::max(group.size(), index + 1));
  group[index] = table[0];
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome LinkRefinementGL::MakeTables(const RefinementTables& tables)
{
  Outcome made = this->MakeTable(this->Pieces, 0, tables.GetPieces());
  made = made ? this->MakeTable(this->Profile, 0, tables.GetProfile()) : made;
  for (int table = 0; made && table < RefinementTables::NumberOfSlotTables; ++table)
  {
    made = this->MakeTable(this->Slots, table, tables.GetSlots(table));
  }
  for (int table = 0; made && table < 2; ++table)
  {
    made = this->MakeTable(this->Bounds, table, tables.GetBounds(table));
  }
  return made;
}

//------------------------------------------------------------------------------
void LinkRefinementGL::MakePasses(const RefinementTables& tables)
{
  vtkOpenGLRenderWindow* window = this->Engine.GetWindow();
  const auto& profile = this->Described->Profile;
  this->TestPass = std::make_unique<FeedbackPass>(window,
    Define(vtkLightTransportRefinementTestVS,
      DefineNumber("WIDTH_BITS", WidthBits) +
        DefineNumber("PLACE_BITS", RefinementTables::MantissaBits - profile.PieceBits) +
        DefineNumber("SINGULAR", profile.IsSingular ? 1 : 0)),
    "", std::vector<std::string>{ "entry" },
    std::vector<std::string>{ "tested", "value", "deviation2" });
  const std::vector<std::string> attributes{ "entry", "entryValue", "entryDeviation2" };
  this->TakePass = std::make_unique<FeedbackPass>(window, vtkLightTransportRefinementPairVS,
    vtkLightTransportRefinementTakeGS, attributes,
    std::vector<std::string>{ "part", "partValue", "partDeviation2" });
  this->DividePass = std::make_unique<FeedbackPass>(window, vtkLightTransportRefinementPairVS,
    Define(vtkLightTransportRefinementDivideGS,
      DefineNumber("WIDTH_BITS", WidthBits) +
        DefineNumber("MOST_PAIRS", tables.GetMostChildren() + 1)),
    attributes, std::vector<std::string>{ "follower" });
}

//------------------------------------------------------------------------------
Outcome LinkRefinementGL::Refine(vtkIdType first, vtkIdType last, const Pause& pause,
  std::vector<Part>& parts)
{
  std::vector<float> pairs;
  this->AddCover(0, first, last, pairs);
  Outcome done = this->Pairs.Upload(pairs);
  auto count = static_cast<vtkIdType>(pairs.size()) / VectorBuffer::FloatsPerVector;
  vtkIdType taken = 0;
  while (done && count > 0)
  {
    vtkIdType followers = 0;
    done = this->Test(count);
    done = done ? this->Take(count, taken) : done;
    done = done ? this->Divide(count, followers) : done;
    count = followers;
    pause();
  }
  return done ? this->Read(taken, first, last, parts) : done;
}

//------------------------------------------------------------------------------
// The largest nodes of the range, each with the root as its sender.
void LinkRefinementGL::AddCover(int slot, vtkIdType first, vtkIdType last,
  std::vector<float>& pairs) const
{
  const vtkDeviceLinkRefiner::Slot& place = this->Described->Slots[slot];
  if (place.FirstPatch >= last || place.LastPatch <= first)
  {
    return;
  }
  if (place.FirstPatch >= first && place.LastPatch <= last)
  {
    pairs.insert(pairs.end(), { static_cast<float>(slot), 0.0f, 0.0f, 0.0f });
    return;
  }
  for (int child = place.FirstChild; child < place.LastChild; ++child)
  {
    this->AddCover(child, first, last, pairs);
  }
}

//------------------------------------------------------------------------------
Outcome LinkRefinementGL::UseTest(vtkShaderProgram*& program)
{
  if (Outcome used = this->TestPass->Use(program); !used)
  {
    return used;
  }
  const Body& body = *this->Described;
  float decays[3];
  for (int band = 0; band < vtkDeviceLinkRefiner::NumberOfBands; ++band)
  {
    decays[band] = static_cast<float>(body.Profile.Decays[band] / this->LengthFactor);
  }
  this->Engine.SetTextures(program, "places", this->Slots);
  this->Engine.SetTextures(program, "pieces", this->Pieces);
  this->Engine.SetTextures(program, "profile", this->Profile);
  this->Engine.SetTextures(program, "bounds", this->Bounds);
  const auto setFloat = [&](const char* name, double value)
  { program->SetUniformf(name, static_cast<float>(value)); };
  program->SetUniformi("nodes", body.NumberOfNodes);
  program->SetUniformi("firstPiece", this->FirstPiece);
  program->SetUniformi("pieceCount", static_cast<int>(body.Profile.Pieces.size()));
  program->SetUniformf("squaredCore", this->SquaredCore);
  program->SetUniform3f("decays", decays);
  setFloat("leaveOut", this->ValueFactor * body.LeaveOut);
  setFloat("relativeTolerance", body.RelativeTolerance);
  setFloat("tolerancePerArea", this->ValueFactor * body.TolerancePerArea);
  setFloat("widestSpread2", body.WidestSpread2);
  setFloat("errorOfCorrection", body.ErrorOfCorrection);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome LinkRefinementGL::Test(vtkIdType count)
{
  vtkShaderProgram* program = nullptr;
  vtkIdType written = 0;
  Outcome done = this->UseTest(program);
  done = done ? this->TestPass->Run(this->Pairs, count, this->Tested, 0, written) : done;
  this->Engine.ReleaseTextures();
  this->NumberOfTests += count;
  return done && written != count ? Outcome::Failed("links that it does not capture") : done;
}

//------------------------------------------------------------------------------
Outcome LinkRefinementGL::Take(vtkIdType count, vtkIdType& taken)
{
  vtkShaderProgram* program = nullptr;
  vtkIdType written = 0;
  Outcome done = this->TakePass->Use(program);
  if (done)
  {
    program->SetUniformi("nodes", this->Described->NumberOfNodes);
    done = this->TakePass->Run(this->Tested, count, this->Taken, taken, written);
    taken += written;
  }
  return done;
}

//------------------------------------------------------------------------------
Outcome LinkRefinementGL::Divide(vtkIdType count, vtkIdType& followers)
{
  vtkShaderProgram* program = nullptr;
  Outcome done = this->DividePass->Use(program);
  if (done)
  {
    this->Engine.SetTextures(program, "children",
      { this->Slots[RefinementTables::TableOfChildren] });
    program->SetUniformi("nodes", this->Described->NumberOfNodes);
    done = this->DividePass->Run(this->Tested, count, this->Followers, 0, followers);
    this->Engine.ReleaseTextures();
    this->Pairs.Swap(this->Followers);
  }
  return done;
}

//------------------------------------------------------------------------------
// What OpenGL has counted wrong must not lead anywhere.
Outcome LinkRefinementGL::Read(vtkIdType taken, vtkIdType first, vtkIdType last,
  std::vector<Part>& parts) const
{
  static constexpr vtkDeviceLinkRefiner::Kind kinds[] = { vtkDeviceLinkRefiner::Kind::Link,
    vtkDeviceLinkRefiner::Kind::Divided, vtkDeviceLinkRefiner::Kind::Patch,
    vtkDeviceLinkRefiner::Kind::LeftOut };
  constexpr int firstKind = 2;
  std::vector<float> values;
  this->Taken.Download(taken, values);
  parts.resize(static_cast<std::size_t>(taken));
  const auto slots = static_cast<vtkIdType>(this->Described->Slots.size());
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    const float* const record = values.data() + FloatsOfPart * k;
    const auto receiver = static_cast<vtkIdType>(record[0]) - this->Described->NumberOfNodes;
    const auto slot = static_cast<vtkIdType>(record[1]);
    const int kind = static_cast<int>(record[2]) - firstKind;
    if (receiver < first || receiver >= last || slot < 0 || slot >= slots || kind < 0 || kind > 3)
    {
      return Outcome::Failed("links that do not exist");
    }
    Part& part = parts[k];
    part.Receiver = static_cast<int>(receiver);
    part.Slot = static_cast<int>(slot);
    part.What = kinds[kind];
    part.IsFactor = record[7] > 0.0f;
    std::copy_n(record + 4, 3, part.Value.begin());
    std::copy_n(record + 8, 3, part.Deviation2.begin());
  }
  return Outcome::Done();
}
} // namespace LightTransport
