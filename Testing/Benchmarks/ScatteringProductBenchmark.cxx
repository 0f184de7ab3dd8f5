// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * CPU seconds that applying rows of links takes with OpenGL, as scattering has them: uniform and
 * adaptive, as they are and coded, for numbers of receivers, links, kernels and lights; and as
 * radiosity has them whose links are sampled, between patches alone, for numbers of bands. Beside
 * each stand two plain shaders that read texels and add them up: as many bytes as the links have,
 * and as many as links and what is sent along them have together.
 *
 * Not a test: times depend on the machine. CPU seconds of all threads say what a software renderer
 * does; of a GPU they say nothing.
 */
#include "ShaderPass.h"
#include "vtkOffScreenOpenGLRenderWindow.h"
#include "vtkOpenGLLinkOperator.h"

#include "vtkExchangeHierarchy.h"
#include "vtkHierarchicalLinkOperator.h"
#include "vtkNew.h"
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
#include <string>
#include <vector>

namespace
{
constexpr const char* Usage = "usage: ScatteringProductBenchmark [TEXELS_A_SIDE ...]\n"
                              "  receivers are all texels of a square of that size (512)\n"
                              "or ScatteringProductBenchmark --plain TEXELS_A_SIDE BYTES\n"
                              "  CPU seconds of the plain shader alone that reads so many bytes\n";

constexpr int Samples = 5;
constexpr int Width = 1024;
constexpr int HighestTexture = 8192;
constexpr int BytesPerTexel = 16;
constexpr int LargestSampledSide = 128;

enum class Form
{
  Uniform,
  Adaptive,
  Sampled
};

struct Setting
{
  Form Rows;
  bool IsCoded;
  int Links;
  int Kernels;
  int Lights; ///< or bands
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
  if (setting.Rows == Form::Uniform)
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
/// Patches that see each other are anywhere.
bool FillSampledRows(vtkExchangeHierarchy* hierarchy, int patches, const Setting& setting)
{
  std::vector<std::vector<int>> rows(patches);
  for (int patch = 0; patch < patches; ++patch)
  {
    for (int k = 0; k < setting.Links / 2; ++k)
    {
      const int other =
        static_cast<int>(static_cast<double>(PairValue(patch, 1000000 + k)) * patches);
      rows[patch].push_back(other);
      rows[other].push_back(patch);
    }
  }
  const int nodes = hierarchy->GetNumberOfNodes();
  std::vector<std::int64_t> offsets(nodes + 1, 0);
  std::vector<int> columns;
  std::vector<float> values;
  for (std::vector<int>& row : rows)
  {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    for (const int other : row)
    {
      columns.push_back(nodes + other);
      values.push_back(1.0f / static_cast<float>(setting.Links));
    }
    offsets.push_back(static_cast<std::int64_t>(columns.size()));
  }
  return hierarchy->SetRows(offsets, columns, values, true);
}

//------------------------------------------------------------------------------
bool FillRows(vtkExchangeHierarchy* hierarchy, int patches, const Setting& setting)
{
  if (!hierarchy->SetTree(std::vector<double>(patches, 1.0), MakeTree(patches), 0, 1,
        setting.Kernels))
  {
    return false;
  }
  if (setting.Rows == Form::Sampled)
  {
    return FillSampledRows(hierarchy, patches, setting);
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
    : TexelsPerReceiver(
        std::max(1, static_cast<int>(std::lround(bytes / BytesPerTexel / patches)))),
      Pass(window,
        "uniform sampler2D values;\nuniform int count;\n"
        "void main()\n{\n  ivec2 place = ivec2(gl_FragCoord.xy);\n  vec4 sum = vec4(0.0);\n"
        "  for (int k = 0; k < count; ++k)\n  {\n"
        "    sum += texelFetch(values, ivec2(place.x, place.y * count + k), 0);\n  }\n"
        "  gl_FragData[0] = sum;\n}\n")
  {
    const int lines = patches / Width;
    const int most = std::min(lines, HighestTexture / this->TexelsPerReceiver);
    const std::vector<float> values(std::size_t(4) * Width * this->TexelsPerReceiver * most, 0.25f);
    for (int line = 0; line < lines; line += most)
    {
      const int height = std::min(most, lines - line) * this->TexelsPerReceiver;
      this->Textures.push_back(ShaderPass::MakeTexture(window, Width, height, 4, values.data()));
    }
    this->Target = ShaderPass::MakeTexture(window, Width, most, 4, nullptr);
  }

  void Draw()
  {
    this->Pass.Begin(this->Target);
    for (vtkTextureObject* texture : this->Textures)
    {
      const auto lines = static_cast<int>(texture->GetHeight()) / this->TexelsPerReceiver;
      this->Pass.Draw({ { "values", texture } }, 0, Width, lines,
        [this](vtkShaderProgram* program)
        { program->SetUniformi("count", this->TexelsPerReceiver); });
    }
    this->Pass.End();
  }

private:
  const int TexelsPerReceiver;
  ShaderPass Pass;
  std::vector<vtkSmartPointer<vtkTextureObject>> Textures;
  vtkSmartPointer<vtkTextureObject> Target;
};

//------------------------------------------------------------------------------
double TimePlainShader(vtkOpenGLRenderWindow* window, int patches, double bytes)
{
  PlainShader plain(window, patches, bytes);
  return GetCPUSeconds([&]() { plain.Draw(); });
}

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
    setting.Rows == Form::Uniform ? 4.0 * setting.Kernels : (setting.Kernels == 1 ? 8.0 : 16.0);
  const double bytes = setting.IsCoded ? hierarchy->GetNumberOfLinkBytes() : plainBytes * count;
  // Of each link of a row what its other end sends is read too.
  const double directions = hierarchy->IsSymmetric() ? 2.0 : 1.0;
  const double linkBytes = directions * bytes;
  const double allBytes = linkBytes + directions * count * BytesPerTexel * ((bands + 3) / 4);
  const double seconds = GetCPUSeconds([&]() { Apply(links); });
  const double difference = GetDifference(links, hierarchy, bands, sent);
  links->Release();
  window->MakeCurrent();
  const double plainSeconds = TimePlainShader(window, patches, linkBytes);
  const double allSeconds = TimePlainShader(window, patches, allBytes);
  const char* const names[] = { "uniform", "adaptive", "sampled" };
  std::cout << std::setw(5) << side << std::setw(10) << names[static_cast<int>(setting.Rows)]
            << std::setw(7) << (setting.IsCoded ? "coded" : "") << std::fixed
            << std::setprecision(1) << std::setw(8) << directions * count / patches << std::setw(8)
            << setting.Kernels << std::setw(7) << setting.Lights << std::setw(8) << linkBytes * 1e-6
            << std::setw(8) << allBytes * 1e-6 << std::setprecision(4) << std::setw(9) << seconds
            << std::setw(9) << plainSeconds << std::setw(9) << allSeconds << std::setprecision(1)
            << std::setw(7) << seconds / plainSeconds << std::setw(7) << seconds / allSeconds
            << std::scientific << std::setw(10) << difference << std::endl;
  return true;
}
} // namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  std::vector<std::string> arguments(argv + 1, argv + argc);
  double plainBytes = 0.0;
  if (arguments.size() == 3 && arguments[0] == "--plain")
  {
    plainBytes = std::atof(arguments[2].c_str());
    arguments = { arguments[1] };
  }
  std::vector<int> sides;
  for (const std::string& argument : arguments)
  {
    sides.push_back(std::atoi(argument.c_str()));
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
  if (plainBytes > 0.0)
  {
    std::cout << TimePlainShader(window, sides[0] * sides[0], plainBytes) << std::endl;
    return EXIT_SUCCESS;
  }
  std::cout << "texels      form          links kernels lights      MB  MB all    CPU s    plain"
               "      all  times  times difference\n";
  bool done = true;
  const auto run = [&]()
  {
    for (const int side : sides)
    {
      for (const Setting& setting :
        { Setting{ Form::Uniform, false, 16, 3, 1 }, Setting{ Form::Uniform, false, 64, 3, 1 },
          Setting{ Form::Uniform, false, 64, 1, 1 }, Setting{ Form::Uniform, false, 64, 3, 4 },
          Setting{ Form::Uniform, true, 16, 3, 1 }, Setting{ Form::Uniform, true, 64, 3, 1 },
          Setting{ Form::Adaptive, false, 16, 3, 1 }, Setting{ Form::Adaptive, false, 64, 3, 1 },
          Setting{ Form::Adaptive, true, 64, 3, 1 }, Setting{ Form::Sampled, false, 64, 1, 1 },
          Setting{ Form::Sampled, false, 64, 1, 3 }, Setting{ Form::Sampled, false, 400, 1, 3 } })
      {
        // Of sampled links a row has hundreds.
        const int receivers =
          setting.Rows == Form::Sampled ? std::min(side, LargestSampledSide) : side;
        done = done && Run(window, receivers, setting);
      }
    }
  };
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 0, "STDThread", false }, run);
  return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
