// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Runs a fuzz target (LLVMFuzzerTestOneInput, as libFuzzer calls it) on mutated files of its
// corpus.
//
// Input `n` of a seed depends on the corpus, the seed and `n` alone, whatever compiler and machine.
// Each run is watched: one that crashes, that takes more than its processor time, or that asks for
// more memory at once than it may, ends the process that runs the target; the input is then kept in
// the current folder, and a new process goes on with the next one. A target linked with libFuzzer
// instead of this file (clang, -fsanitize=fuzzer) is guided by what its code does.
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <new>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace
{
using Bytes = std::vector<std::uint8_t>;

// Instruments make a program some ten times slower.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr long UsualPatience = 100;
#else
constexpr long UsualPatience = 10;
#endif

struct Settings
{
  std::vector<Bytes> Corpus;
  std::string Name;
  std::uint64_t First = 0;
  std::uint64_t Runs = 1000;
  std::uint64_t Seed = 1;
  /// 0: no limit.
  long Seconds = 0;
  /// Processor time of all threads of one run, in seconds.
  long Patience = UsualPatience;
};

// The largest block of memory that a run may ask for, and what it is compared with outside of runs.
std::atomic<std::size_t> LargestBlock{ std::numeric_limits<std::size_t>::max() };
std::size_t AllowedBlock = std::size_t{ 1 } << 30;

// Nobody looks at more of them before the first ones are mended.
constexpr std::uint64_t MostFound = 100;

//------------------------------------------------------------------------------
class Random
{
public:
  Random(std::uint64_t seed, std::uint64_t run) : Engine(seed * 0x9E3779B97F4A7C15ull + run)
  {
    this->Engine.discard(2);
  }
  /// 0 to count - 1. (The distributions of the standard library differ from one to another.)
  std::size_t Index(std::size_t count) { return count > 0 ? this->Engine() % count : 0; }

private:
  std::mt19937_64 Engine;
};

//------------------------------------------------------------------------------
// Any place, or one near the beginning, where headers are.
std::size_t ChoosePlace(Random& random, const Bytes& bytes)
{
  const std::size_t count = bytes.size() + 1;
  return random.Index(random.Index(2) == 0 ? count : std::min<std::size_t>(count, 512));
}

//------------------------------------------------------------------------------
// Numbers that programs forget, in 1 to 8 bytes.
void OverwriteNumber(Random& random, Bytes& bytes)
{
  constexpr std::uint64_t numbers[] = { 0, 1, 2, 16, 0x7F, 0x80, 0xFF, 0x100, 0x7FFF, 0x8000,
    0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x7F800000, 0x7FC00000, 0xFF7FFFFF,
    0x7FFFFFFFFFFFFFFF, 0x8000000000000000, 0xFFFFFFFFFFFFFFFF, 0x7FF0000000000000,
    0x7FF8000000000000, 0x7FEFFFFFFFFFFFFF, 0x0010000000000000 };
  const std::uint64_t number = numbers[random.Index(std::size(numbers))];
  const std::size_t place = ChoosePlace(random, bytes);
  const std::size_t width = std::size_t{ 1 } << random.Index(4);
  const std::size_t count = std::min(width, bytes.size() - place);
  std::memcpy(bytes.data() + place, &number, count);
}

//------------------------------------------------------------------------------
void MutateOnce(Random& random, const std::vector<Bytes>& corpus, Bytes& bytes)
{
  const std::size_t place = ChoosePlace(random, bytes);
  const std::size_t length = random.Index(std::min<std::size_t>(bytes.size() - place, 64) + 1);
  const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(place);
  const auto end = at + static_cast<std::ptrdiff_t>(length);
  switch (random.Index(8))
  {
    case 0: // one bit
      if (at != bytes.end())
      {
        *at ^= static_cast<std::uint8_t>(1u << random.Index(8));
      }
      break;
    case 1: // a few bytes
      std::generate(at, end, [&] { return static_cast<std::uint8_t>(random.Index(256)); });
      break;
    case 2:
      OverwriteNumber(random, bytes);
      break;
    case 3: // a little more or less
      if (at != bytes.end())
      {
        *at = static_cast<std::uint8_t>(*at + random.Index(33) - 16);
      }
      break;
    case 4:
      bytes.erase(at, end);
      break;
    case 5:
    {
      const Bytes copy(at, end);
      bytes.insert(at, copy.begin(), copy.end());
      break;
    }
    case 6: // a part of another file
    {
      const Bytes& other = corpus[random.Index(corpus.size())];
      const std::size_t from = ChoosePlace(random, other);
      const std::size_t count =
        random.Index(std::min(other.size() - from, bytes.size() - place) + 1);
      std::copy_n(other.begin() + static_cast<std::ptrdiff_t>(from), count, at);
      break;
    }
    default: // cut short, now and then
      if (random.Index(4) == 0)
      {
        bytes.erase(at, bytes.end());
      }
      break;
  }
}

//------------------------------------------------------------------------------
Bytes MakeInput(const Settings& settings, std::uint64_t run)
{
  Random random(settings.Seed, run);
  Bytes bytes = settings.Corpus[random.Index(settings.Corpus.size())];
  for (std::size_t k = random.Index(8) + 1; k > 0; --k)
  {
    MutateOnce(random, settings.Corpus, bytes);
  }
  return bytes;
}

//------------------------------------------------------------------------------
void RunOnce(const Bytes& bytes)
{
  LargestBlock = AllowedBlock;
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  LargestBlock = std::numeric_limits<std::size_t>::max();
}

//------------------------------------------------------------------------------
// Signals end the process unless the run ends before: by processor time, and by the clock for one
// that waits for ever (a busy machine may give it little time).
void Watch(long seconds)
{
  const itimerval processor = { {}, { seconds, 0 } };
  setitimer(ITIMER_PROF, &processor, nullptr);
  alarm(static_cast<unsigned int>(seconds * 60));
}

//------------------------------------------------------------------------------
// All inputs from `next` on, in this process; `next` is the one that runs.
[[noreturn]] void RunAll(const Settings& settings, volatile std::uint64_t& next,
  std::time_t deadline)
{
  const rlimit none = { 0, 0 };
  setrlimit(RLIMIT_CORE, &none);
  for (; next < settings.First + settings.Runs; next = next + 1)
  {
    if (deadline > 0 && std::time(nullptr) >= deadline)
    {
      break;
    }
    const Bytes bytes = MakeInput(settings, next);
    Watch(settings.Patience);
    RunOnce(bytes);
  }
  Watch(0);
  std::_Exit(0);
}

//------------------------------------------------------------------------------
// One finding: its input in a file, and a line.
void Keep(const Settings& settings, std::uint64_t run, int status)
{
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  const bool hangs = signal == SIGPROF || signal == SIGALRM;
  const std::string name = settings.Name + (hangs ? "-hang-" : "-crash-") +
    std::to_string(settings.Seed) + "-" + std::to_string(run);
  const Bytes bytes = MakeInput(settings, run);
  std::ofstream(name, std::ios::binary)
    .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  std::fprintf(stderr, "FOUND %s (%s)\n", name.c_str(),
    signal > 0 ? strsignal(signal) : "it ended the process");
}

//------------------------------------------------------------------------------
int Fuzz(const Settings& settings)
{
  auto* next = static_cast<volatile std::uint64_t*>(mmap(nullptr, sizeof(std::uint64_t),
    PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  *next = settings.First;
  const std::time_t deadline = settings.Seconds > 0 ? std::time(nullptr) + settings.Seconds : 0;
  std::uint64_t found = 0;
  int status = 1;
  while (status != 0 && found < MostFound)
  {
    const pid_t child = fork();
    if (child == 0)
    {
      RunAll(settings, *next, deadline);
    }
    if (child < 0 || waitpid(child, &status, 0) != child)
    {
      std::perror("no process can be started");
      return EXIT_FAILURE;
    }
    if (status != 0)
    {
      Keep(settings, *next, status);
      *next = *next + 1;
      ++found;
    }
  }
  std::fprintf(stderr, "%s: %llu runs of seed %llu, %llu found\n", settings.Name.c_str(),
    static_cast<unsigned long long>(*next - settings.First),
    static_cast<unsigned long long>(settings.Seed), static_cast<unsigned long long>(found));
  return found == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

//------------------------------------------------------------------------------
Bytes Load(const std::filesystem::path& path)
{
  std::ifstream stream(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
}

//------------------------------------------------------------------------------
// The files of a folder, by name; a file is itself.
std::vector<Bytes> LoadCorpus(const std::filesystem::path& path)
{
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(path))
  {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Bytes> corpus;
  std::transform(files.begin(), files.end(), std::back_inserter(corpus), Load);
  return corpus;
}

//------------------------------------------------------------------------------
// An option of the command line; false for one that is unknown.
bool Take(const std::string& option, std::uint64_t value, Settings& settings)
{
  if (option == "--runs")
  {
    settings.Runs = value;
  }
  else if (option == "--first")
  {
    settings.First = value;
  }
  else if (option == "--seed")
  {
    settings.Seed = value;
  }
  else if (option == "--seconds")
  {
    settings.Seconds = static_cast<long>(value);
    settings.Runs = std::numeric_limits<std::uint64_t>::max() / 2;
  }
  else if (option == "--patience")
  {
    settings.Patience = static_cast<long>(value);
  }
  else if (option == "--megabytes")
  {
    AllowedBlock = static_cast<std::size_t>(value) << 20;
  }
  else
  {
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
void CheckBlock(std::size_t bytes)
{
  if (bytes > LargestBlock)
  {
    LargestBlock = std::numeric_limits<std::size_t>::max();
    std::fprintf(stderr, "%zu bytes are asked for at once\n", bytes);
    std::abort();
  }
}
#endif
} // namespace

// Sanitizers have an option for it: max_allocation_size_mb.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
extern "C"
{
  // What the C library has beneath those that are replaced here.
  void* AllocateBlock(std::size_t bytes) __asm__("__libc_malloc");
  void* AllocateZeros(std::size_t count, std::size_t bytes) __asm__("__libc_calloc");
  void* ResizeBlock(void* block, std::size_t bytes) __asm__("__libc_realloc");

  void* malloc(std::size_t bytes) noexcept
  {
    CheckBlock(bytes);
    return AllocateBlock(bytes);
  }

  void* calloc(std::size_t count, std::size_t bytes) noexcept
  {
    CheckBlock(bytes == 0 ? 0 : count <= SIZE_MAX / bytes ? count * bytes : SIZE_MAX);
    return AllocateZeros(count, bytes);
  }

  void* realloc(void* block, std::size_t bytes) noexcept
  {
    CheckBlock(bytes);
    return ResizeBlock(block, bytes);
  }
}

//------------------------------------------------------------------------------
// Who asks so takes no for an answer.
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept
{
  return bytes > LargestBlock ? nullptr : AllocateBlock(bytes);
}
#endif

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  Settings settings;
  settings.Name = std::filesystem::path(argv[0]).filename().string();
  bool understood = argc >= 2 && argc % 2 == 0;
  for (int i = 2; i + 1 < argc && understood; i += 2)
  {
    understood = Take(argv[i], std::strtoull(argv[i + 1], nullptr, 10), settings);
  }
  if (!understood)
  {
    std::fprintf(stderr,
      "%s CORPUS [--runs N | --seconds S] [--seed N] [--first N] [--patience SECONDS] "
      "[--megabytes N]\n%s FILE   runs one input, unwatched\n",
      settings.Name.c_str(), settings.Name.c_str());
    return EXIT_FAILURE;
  }
  if (!std::filesystem::is_directory(argv[1]))
  {
    RunOnce(Load(argv[1]));
    return EXIT_SUCCESS;
  }
  settings.Corpus = LoadCorpus(argv[1]);
  return settings.Corpus.empty() ? EXIT_FAILURE : Fuzz(settings);
}
