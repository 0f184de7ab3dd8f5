// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What came of a step of work: it is done, it failed with a message that names the problem and the
 * remedy, or somebody aborted it. The one way in which private code says so; exceptions are left to
 * the borders of libraries that throw. A filter reports the message of a failure, and nothing for
 * an abort.
 *
 * True where the step is done, so that steps chain:
 *
 *   if (Outcome read = this->Read(input); !read)
 *   {
 *     return read;
 *   }
 */
#ifndef Outcome_h
#define Outcome_h

#include <string>
#include <utility>

namespace LightTransport
{
class [[nodiscard]] Outcome
{
public:
  static Outcome Done() { return Outcome(State::Done, {}); }
  static Outcome Aborted() { return Outcome(State::Aborted, {}); }
  static Outcome Failed(std::string message) { return Outcome(State::Failed, std::move(message)); }
  /// A failure that has been reported where it happened, as VTK's own classes do.
  static Outcome FailedAsReported() { return Failed({}); }
  /// Done, or aborted where something that reports progress said that it is to stop.
  static Outcome DoneUnlessAborted(bool goesOn) { return goesOn ? Done() : Aborted(); }

  explicit operator bool() const { return this->Which == State::Done; }
  bool IsAborted() const { return this->Which == State::Aborted; }
  bool HasFailed() const { return this->Which == State::Failed; }
  /// Of a failure; empty where it has been reported already.
  const std::string& GetMessage() const { return this->Message; }

private:
  enum class State
  {
    Done,
    Aborted,
    Failed
  };
  Outcome(State which, std::string message) : Which(which), Message(std::move(message)) {}

  State Which;
  std::string Message;
};
} // namespace LightTransport

#endif
