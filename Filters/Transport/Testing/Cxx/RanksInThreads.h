// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Several ranks in one process, each a thread: parallel code is tested without MPI.
#ifndef RanksInThreads_h
#define RanksInThreads_h

#include "vtkAbstractArray.h"
#include "vtkCommunicator.h"
#include "vtkDummyController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <thread>
#include <tuple>
#include <vector>

namespace LightTransportTesting
{
/// Messages between the ranks, in the order they were sent.
class Mailbox
{
public:
  void Send(int from, int to, int tag, std::vector<char> message)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Messages[{ from, to, tag }].push_back(std::move(message));
    this->Arrived.notify_all();
  }

  std::vector<char> Receive(int from, int to, int tag)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    std::deque<std::vector<char>>& messages = this->Messages[{ from, to, tag }];
    this->Arrived.wait(lock, [&]() { return !messages.empty(); });
    std::vector<char> message = std::move(messages.front());
    messages.pop_front();
    return message;
  }

private:
  std::mutex Mutex;
  std::condition_variable Arrived;
  std::map<std::tuple<int, int, int>, std::deque<std::vector<char>>> Messages;
};

/// The collective calls are those of vtkCommunicator.
class ThreadCommunicator : public vtkCommunicator
{
public:
  /// Whether this thread is in a call, whose memory is none of what is tested.
  static bool& IsCalled()
  {
    thread_local bool called = false;
    return called;
  }

  static ThreadCommunicator* New() { VTK_STANDARD_NEW_BODY(ThreadCommunicator); }
  vtkTypeMacro(ThreadCommunicator, vtkCommunicator);

  void Join(Mailbox& mailbox, int rank, int ranks)
  {
    this->Box = &mailbox;
    this->LocalProcessId = rank;
    this->NumberOfProcesses = this->MaximumNumberOfProcesses = ranks;
  }

  int SendVoidArray(const void* data, vtkIdType length, int type, int to, int tag) override
  {
    const auto* bytes = static_cast<const char*>(data);
    this->Box->Send(this->LocalProcessId, to, tag,
      { bytes, bytes + length * vtkAbstractArray::GetDataTypeSize(type) });
    return 1;
  }

  int ReceiveVoidArray(void* data, vtkIdType length, int type, int from, int tag) override
  {
    const std::vector<char> message = this->Box->Receive(from, this->LocalProcessId, tag);
    const vtkIdType size = vtkAbstractArray::GetDataTypeSize(type);
    this->Count = static_cast<vtkIdType>(message.size()) / size;
    std::copy(message.begin(), message.end(), static_cast<char*>(data));
    return this->Count <= length ? 1 : 0;
  }

  int AllReduceVoidArray(const void* mine, void* all, vtkIdType length, int type,
    int operation) override
  {
    const Call call;
    return this->Superclass::AllReduceVoidArray(mine, all, length, type, operation);
  }
  int AllGatherVoidArray(const void* mine, void* all, vtkIdType length, int type) override
  {
    const Call call;
    return this->Superclass::AllGatherVoidArray(mine, all, length, type);
  }
  int AllGatherVVoidArray(const void* mine, void* all, vtkIdType length, vtkIdType* lengths,
    vtkIdType* offsets, int type) override
  {
    const Call call;
    return this->Superclass::AllGatherVVoidArray(mine, all, length, lengths, offsets, type);
  }
  int BroadcastVoidArray(void* data, vtkIdType length, int type, int from) override
  {
    const Call call;
    return this->Superclass::BroadcastVoidArray(data, length, type, from);
  }

protected:
  ThreadCommunicator() = default;
  ~ThreadCommunicator() override = default;

private:
  ThreadCommunicator(const ThreadCommunicator&) = delete;
  void operator=(const ThreadCommunicator&) = delete;

  struct Call
  {
    Call() { IsCalled() = true; }
    ~Call() { IsCalled() = false; }
    Call(const Call&) = delete;
    void operator=(const Call&) = delete;
  };

  Mailbox* Box = nullptr;
};

/// Calls work(controller, rank) on every rank at the same time. vtkSMPTools, whose backend belongs
/// to the whole process, is sequential from here on.
template <typename Work>
void RunRanks(int ranks, Work&& work)
{
  vtkSMPTools::SetBackend("Sequential");
#ifdef _WIN32
  _putenv_s("VTK_SMP_BACKEND_IN_USE", "Sequential");
#else
  setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 1);
#endif
  Mailbox mailbox;
  std::vector<std::thread> threads;
  for (int rank = 0; rank < ranks; ++rank)
  {
    threads.emplace_back(
      [&mailbox, &work, rank, ranks]()
      {
        vtkNew<ThreadCommunicator> communicator;
        communicator->Join(mailbox, rank, ranks);
        vtkNew<vtkDummyController> controller;
        controller->SetCommunicator(communicator);
        work(controller, rank);
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}
} // namespace LightTransportTesting

#endif
