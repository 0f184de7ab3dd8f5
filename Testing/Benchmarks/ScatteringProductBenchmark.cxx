// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * CPU seconds that applying rows of links takes with OpenGL, as scattering has them: uniform and
 * adaptive, as they are and coded, for numbers of receivers, links, kernels and lights. Beside each
 * stands a plain shader that reads as many bytes of texels as the links have and adds them up.
 *
 * Not a test: times depend on the machine. CPU seconds of all threads say what a software renderer
 * does; of a GPU they say nothing.
 */
#include "Context/OpenGLFunctions.h"
#include "vtkOffScreenOpenGLRenderWindow.h"
#include "vtkOpenGLLinkOperator.h"

#include "vtkExchangeHierarchy.h"
#include "vtkHierarchicalLinkOperator.h"
#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkSMPTools.h"
#include "vtkShaderProgram.h"
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <iomanip>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace
{
constexpr const char* Usage = "usage: ScatteringProductBenchmark [TEXELS_A_SIDE ...]\n"
                              "  receivers are all texels of a square of that size (512)\n";

constexpr int Samples = 5;
constexpr int Width = 1024;
constexpr int HighestTexture = 8192;
constexpr int BytesPerTexel = 16;

struct Setting
{
  bool IsUniform;
  bool IsCoded;
  int Links;
  int Kernels;
  int Lights;
};

/// A value in [0, 1) for a pair of numbers.
float PairValue(std::uint64_t i, std::uint64_t j)
{
  std::uint64_t key = (i << 32) + j;
  key = (key ^ (key >> 31)) * 0x9E3779B97F4A7C15ull;
  key = (key ^ (key >> 29)) * 0xBF58476D1CE4E5B9ull;
  return static_cast<float>(static_cast<double>(key >> 40) * 0x1p-24);
}

//------------------------------------------------------------------------------
/// A quadtree down to 4 patches a node.
std::vector<vtkExchangeHierarchy::Node> MakeTree(int patches)
{
  std::vector<vtkExchangeHierarchy::Node> nodes;
  int first = 1;
  for (int count = 1; count < patches; count *= 4)
  {
    for (int node = 0; node < count; ++node)
    {
      nodes.push_back({ first + 4 * node, first + 4 * node + 4 });
    }
    first += 4 * count;
  }
  return nodes;
}

//------------------------------------------------------------------------------
/// Uniform: the nodes of one level, but the receiver's own, whose children are taken. Adaptive:
/// the own node of each level gives its other children, and neighbours of it.
void CollectRow(const vtkExchangeHierarchy* hierarchy, int patch, const Setting& setting,
  std::vector<int>& row)
{
  const std::vector<int>& levels = hierarchy->GetLevels();
  const int last = static_cast<int>(levels.size()) - 1;
  if (setting.IsUniform)
  {
    int level = 0;
    while (levels[level + 1] - levels[level] < setting.Links)
    {
      ++level;
    }
    int own = patch;
    for (int k = last; k > level; --k)
    {
      own /= 4;
    }
    for (int node = levels[level]; node < levels[level + 1]; ++node)
    {
      if (node != levels[level] + own)
      {
        row.push_back(node);
      }
    }
    const vtkExchangeHierarchy::Node children = hierarchy->GetNodes()[levels[level] + own];
    row.insert(row.end(),
      { children.First, children.First + 1, children.First + 2, children.First + 3 });
    return;
  }
  int own = patch;
  const int perLevel = setting.Links / last + 1;
  for (int level = last; level > 0 && static_cast<int>(row.size()) < setting.Links; --level)
  {
    const int first = level == last ? hierarchy->GetNumberOfNodes() : levels[level];
    const int count = 1 << (2 * level);
    for (int k = 0; k < std::min(count, perLevel); ++k)
    {
      row.push_back(first + (own + count - perLevel / 2 + k) % count);
    }
    own /= 4;
  }
}

//------------------------------------------------------------------------------
bool FillRows(vtkExchangeHierarchy* hierarchy, int patches, const Setting& setting)
{
  if (!hierarchy->SetTree(std::vector<double>(patches, 1.0), MakeTree(patches), 0, 1,
        setting.Kernels))
  {
    return false;
  }
  std::vector<std::int64_t> offsets(hierarchy->GetNumberOfNodes() + 1, 0);
  std::vector<int> columns;
  std::vector<float> values;
  std::vector<int> row;
  for (int patch = 0; patch < patches; ++patch)
  {
    row.clear();
    CollectRow(hierarchy, patch, setting, row);
    for (const int slot : row)
    {
      columns.push_back(slot);
      for (int kernel = 0; kernel < setting.Kernels; ++kernel)
      {
        values.push_back(PairValue(patch + kernel, slot) / static_cast<float>(patches));
      }
    }
    offsets.push_back(static_cast<std::int64_t>(columns.size()));
  }
  const bool done = hierarchy->SetRows(offsets, columns, values);
  if (done && setting.IsCoded)
  {
    hierarchy->CompressRows(0.0);
  }
  return done;
}

//------------------------------------------------------------------------------
/// The median of the process.
double GetCPUSeconds(const std::function<void()>& work)
{
  work();
  std::vector<double> times;
  for (int sample = 0; sample < Samples; ++sample)
  {
    const std::clock_t begin = std::clock();
    work();
    times.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  std::sort(times.begin(), times.end());
  return times[Samples / 2];
}

//------------------------------------------------------------------------------
/// Textures as high as they may be, with a number of texels for each of the receivers.
class PlainShader
{
public:
  PlainShader(vtkOpenGLRenderWindow* window, int patches, double bytes)
    : Window(window),
      TexelsPerReceiver(std::max(1, static_cast<int>(std::lround(bytes / BytesPerTexel / patches))))
  {
    const int lines = patches / Width;
    const int most = std::min(lines, HighestTexture / this->TexelsPerReceiver);
    const std::vector<float> values(std::size_t(4) * Width * this->TexelsPerReceiver * most, 0.25f);
    for (int line = 0; line < lines; line += most)
    {
      this->Textures.push_back(this->MakeTexture(std::min(most, lines - line), values.data()));
    }
    this->Target = this->MakeTexture(most, nullptr, 1);
    this->Framebuffer->SetContext(window);
    this->Quad = std::make_unique<vtkOpenGLQuadHelper>(window,
      "//VTK::System::Dec\nin vec4 ndCoordIn;\nin vec2 texCoordIn;\nvoid main()\n{\n"
      "  gl_Position = vec4(ndCoordIn.x, 2.0 * texCoordIn.y - 1.0, 0.0, 1.0);\n}\n",
      "//VTK::System::Dec\n//VTK::Output::Dec\nuniform sampler2D values;\nuniform int count;\n"
      "void main()\n{\n  ivec2 place = ivec2(gl_FragCoord.xy);\n  vec4 sum = vec4(0.0);\n"
      "  for (int k = 0; k < count; ++k)\n  {\n"
      "    sum += texelFetch(values, ivec2(place.x, place.y * count + k), 0);\n  }\n"
      "  gl_FragData[0] = sum;\n}\n",
      "");
  }

  ~PlainShader()
  {
    this->Quad.reset();
    this->Framebuffer->ReleaseGraphicsResources(this->Window);
  }
  PlainShader(const PlainShader&) = delete;
  void operator=(const PlainShader&) = delete;

  void Draw()
  {
    this->Window->GetState()->PushFramebufferBindings();
    this->Framebuffer->Bind();
    this->Framebuffer->AddColorAttachment(0, this->Target);
    this->Framebuffer->ActivateDrawBuffers(1);
    this->Window->GetState()->vtkglDisable(GL_DEPTH_TEST);
    this->Window->GetState()->vtkglDisable(GL_BLEND);
    for (vtkTextureObject* texture : this->Textures)
    {
      const auto lines = static_cast<int>(texture->GetHeight()) / this->TexelsPerReceiver;
      vtkShaderProgram* program = this->Quad->Program;
      this->Window->GetShaderCache()->ReadyShaderProgram(program);
      texture->Activate();
      program->SetUniformi("values", texture->GetTextureUnit());
      program->SetUniformi("count", this->TexelsPerReceiver);
      this->Window->GetState()->vtkglViewport(0, 0, Width, lines);
      this->Window->GetState()->vtkglScissor(0, 0, Width, lines);
      this->Quad->Render();
      texture->Deactivate();
    }
    this->Window->GetState()->PopFramebufferBindings();
    glFinish();
  }

private:
  vtkSmartPointer<vtkTextureObject> MakeTexture(int lines, const float* values, int perLine = 0)
  {
    auto texture = vtkSmartPointer<vtkTextureObject>::New();
    texture->SetContext(this->Window);
    const int height = lines * (perLine > 0 ? perLine : this->TexelsPerReceiver);
    texture->Allocate2D(Width, height, 4, VTK_FLOAT);
    if (values)
    {
      texture->Activate();
      glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, Width, height, GL_RGBA, GL_FLOAT, values);
      texture->Deactivate();
    }
    return texture;
  }

  vtkOpenGLRenderWindow* Window;
  const int TexelsPerReceiver;
  std::vector<vtkSmartPointer<vtkTextureObject>> Textures;
  vtkSmartPointer<vtkTextureObject> Target;
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  std::unique_ptr<vtkOpenGLQuadHelper> Quad;
};

//------------------------------------------------------------------------------
/// A number read back waits for what has been drawn.
void Apply(vtkLinkOperator* links)
{
  std::vector<double> norm(links->GetNumberOfBands());
  links->Multiply(1, 0);
  links->MaxNorm(1, norm.data());
}

//------------------------------------------------------------------------------
double GetDifference(vtkLinkOperator* links, vtkExchangeHierarchy* hierarchy, int bands,
  const std::vector<double>& sent)
{
  vtkNew<vtkHierarchicalLinkOperator> reference;
  std::vector<double> expected(sent.size());
  std::vector<double> found(sent.size());
  if (!reference->Initialize(hierarchy, bands) || !reference->SetVector(0, sent.data()) ||
    !reference->Multiply(1, 0) || !reference->GetVector(1, expected.data()) ||
    !links->GetVector(1, found.data()))
  {
    return std::nan("");
  }
  double difference = 0.0;
  double largest = 0.0;
  for (std::size_t index = 0; index < found.size(); ++index)
  {
    difference = std::max(difference, std::abs(found[index] - expected[index]));
    largest = std::max(largest, std::abs(expected[index]));
  }
  return difference / largest;
}

//------------------------------------------------------------------------------
bool Run(vtkOffScreenOpenGLRenderWindow* window, int side, const Setting& setting)
{
  const int patches = side * side;
  const int bands = setting.Kernels * setting.Lights;
  vtkNew<vtkExchangeHierarchy> hierarchy;
  vtkNew<vtkOpenGLLinkOperator> links;
  links->SetRenderWindow(window);
  if (!FillRows(hierarchy, patches, setting) || !links->Initialize(hierarchy, bands))
  {
    return false;
  }
  std::vector<double> sent(std::size_t(patches) * bands);
  for (std::size_t index = 0; index < sent.size(); ++index)
  {
    sent[index] = static_cast<double>(PairValue(index, 7));
  }
  if (!links->SetVector(0, sent.data()))
  {
    return false;
  }
  const auto count = static_cast<double>(hierarchy->GetNumberOfLinks());
  // In rows a link takes a texel of three kernels, half of one; what is common its values.
  const double plainBytes =
    setting.IsUniform ? 4.0 * setting.Kernels : (setting.Kernels == 1 ? 8.0 : 16.0);
  const double bytes = setting.IsCoded ? hierarchy->GetNumberOfLinkBytes() : plainBytes * count;
  const double seconds = GetCPUSeconds([&]() { Apply(links); });
  const double difference = GetDifference(links, hierarchy, bands, sent);
  links->Release();
  window->MakeCurrent();
  PlainShader plain(window, patches, bytes);
  const double plainSeconds = GetCPUSeconds([&]() { plain.Draw(); });
  std::cout << std::setw(5) << side << std::setw(10) << (setting.IsUniform ? "uniform" : "adaptive")
            << std::setw(7) << (setting.IsCoded ? "coded" : "") << std::fixed
            << std::setprecision(1) << std::setw(8) << count / patches << std::setw(8)
            << setting.Kernels << std::setw(7) << setting.Lights << std::setw(8) << bytes * 1e-6
            << std::setprecision(3) << std::setw(9) << seconds << std::setw(9) << plainSeconds
            << std::setprecision(1) << std::setw(7) << seconds / plainSeconds << std::scientific
            << std::setw(10) << difference << std::endl;
  return true;
}
} // namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  std::vector<int> sides;
  for (int arg = 1; arg < argc; ++arg)
  {
    sides.push_back(std::atoi(argv[arg]));
    // A quadtree, and whole lines of texels.
    if (sides.back() < 32 || (sides.back() & (sides.back() - 1)) != 0)
    {
      std::cerr << Usage;
      return EXIT_FAILURE;
    }
  }
  sides = sides.empty() ? std::vector<int>{ 512 } : sides;
  vtkNew<vtkOffScreenOpenGLRenderWindow> window;
  window->SetSize(16, 16);
  window->Initialize();
  std::cout << "texels      form          links kernels lights      MB    CPU s    plain  times "
               "difference\n";
  bool done = true;
  const auto run = [&]()
  {
    for (const int side : sides)
    {
      for (const Setting& setting : { Setting{ true, false, 16, 3, 1 },
             Setting{ true, false, 64, 3, 1 }, Setting{ true, false, 64, 1, 1 },
             Setting{ true, false, 64, 3, 4 }, Setting{ true, true, 16, 3, 1 },
             Setting{ true, true, 64, 3, 1 }, Setting{ false, false, 16, 3, 1 },
             Setting{ false, false, 64, 3, 1 }, Setting{ false, true, 64, 3, 1 } })
      {
        done = done && Run(window, side, setting);
      }
    }
  };
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 0, "STDThread", false }, run);
  return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
