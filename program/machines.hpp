#pragma once
/// The programs that share one piece of work, on this machine and others, as seen by one of them: messages between a
/// master, number 0, and workers.
///
/// Open MPI carries them, in a module of its own (mpi_module_main.cpp), which is loaded only if mpirun has started the
/// program: Septet is built and runs without it. Between two programs messages keep their order. A worker may be lost
/// at any time without notice: messages to it are lost, and none come from it. One thread.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"

namespace septet::program {

struct Mail {
  int from = 0;
  Bytes bytes;
};

class Machines {
 public:
  virtual ~Machines() = default;
  virtual int own_number() const = 0;
  virtual int count() const = 0;
  virtual void send(int to, Bytes bytes) = 0;
  /// Does not wait.
  virtual std::optional<Mail> receive() = 0;
  /// Announces the exit status of this program before the end: there it may have to leave the others behind.
  virtual void will_end_with(int status) = 0;
  /// Notes a lost program: at the end not all will arrive, and the others wait only shortly.
  void note_loss() { has_losses_ = true; }
  bool has_losses() const { return has_losses_; }

 private:
  bool has_losses_ = false;
};

using StartMachines = std::unique_ptr<Machines> (*)();

/// Number that mpirun has given to this program; empty if it was not started by mpirun, or alone.
std::optional<int> number_by_mpirun();

/// Connects to all that mpirun has started; waits for them. Error: this Septet was built without Open MPI, or it is not
/// installed.
Expected<std::unique_ptr<Machines>> start_machines();

/// mpirun, ready to work for this user. Error, at `option`: it is not installed, or needs permission to run as root.
Expected<std::filesystem::path> find_mpirun(const std::string& option);
/// Its arguments: to go on when a program dies, with this many programs (0: one for each host) on the machines of a
/// file (empty: this one).
std::vector<std::string> mpirun_arguments(unsigned ranks, const std::filesystem::path& hosts);

/// Threads of this program's share of its machine, beside the others that mpirun has started there. Frees it to run on
/// all processors: mpirun binds each program to one, which suits no program of many threads.
unsigned share_of_processors();

}  // namespace septet::program
