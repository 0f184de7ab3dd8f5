// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Choices that bytes make, so that a mutation of the bytes changes some of them.
#ifndef Choices_h
#define Choices_h

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <limits>

namespace LightTransportFuzz
{
class Choices
{
public:
  Choices(const std::uint8_t* data, std::size_t size) : Next(data), End(data + size)
  {
    for (const std::uint8_t* byte = data; byte != this->End; ++byte)
    {
      this->State = (this->State ^ *byte) * 0x100000001b3;
    }
  }

  /// 0 to count - 1; count is 65,536 at most.
  int Index(int count)
  {
    const int high = count > 256 ? this->Byte() : 0;
    return (high * 256 + this->Byte()) % count;
  }
  bool Chance(int of) { return this->Index(of) == 0; }

  ///@{
  /// Nothing is wrong on purpose from here on: filters look at their input before they begin, and
  /// one strange thing in it keeps them from it.
  void CalmDown() { this->Calm = true; }
  bool IsCalm() const { return this->Calm; }
  /// A chance of something strange.
  bool Strange(int of) { return !this->Calm && this->Chance(of); }
  ///@}

  template <typename Value>
  Value Among(std::initializer_list<Value> values)
  {
    return *std::next(values.begin(), this->Index(static_cast<int>(values.size())));
  }

  /// From 0 to 1.
  double Share() { return this->Index(65536) / 65535.0; }
  double Between(double low, double high) { return low + (high - low) * this->Share(); }

  /// Any number, those that programs forget more often than others.
  double Extreme()
  {
    using Limits = std::numeric_limits<double>;
    const double sign = this->Chance(3) ? -1.0 : 1.0;
    return sign *
      this->Among(
        { 0.0, 1.0, 0.5, 1e-3, 1e3, 1e-12, 1e12, 1e-30, 1e30, 1e-300, 1e300, Limits::denorm_min(),
          Limits::min(), Limits::max(), Limits::infinity(), Limits::quiet_NaN() });
  }
  int ExtremeInteger()
  {
    using Limits = std::numeric_limits<int>;
    return this->Among({ 0, 1, -1, 2, 3, 7, 100, 65536, 1 << 30, Limits::max(), Limits::min() });
  }

private:
  /// Where the bytes are used up the rest follows from all of them.
  int Byte()
  {
    if (this->Next != this->End)
    {
      return *this->Next++;
    }
    this->State = this->State * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<int>((this->State ^ this->State >> 29) >> 32 & 0xFF);
  }

  bool Calm = false;
  const std::uint8_t* Next;
  const std::uint8_t* End;
  std::uint64_t State = 0xcbf29ce484222325;
};
} // namespace LightTransportFuzz

#endif
