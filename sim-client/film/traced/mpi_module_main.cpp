/// septet-mpi.so: the only place that knows Open MPI.
///
/// Nothing here waits for another program but its start: a worker that is lost holds nobody up. What is sent is kept until it is
/// gone. At the end all wait for each other, for a while: mpirun takes one that ends otherwise for one that has failed.

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <list>
#include <thread>

#include "sim-client/film/traced/machines.hpp"

namespace septet::film {
namespace {

constexpr int tag = 15;
constexpr std::size_t most_outgoing = 256;
constexpr std::chrono::seconds patience{10}, patience_without_all{2};

volatile std::sig_atomic_t exit_status = 0;

class MpiMachines : public Machines {
 public:
  MpiMachines() {
    int given = 0;
    ::MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given);
    ::MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    ::MPI_Comm_rank(MPI_COMM_WORLD, &number_);
    ::MPI_Comm_size(MPI_COMM_WORLD, &count_);
  }
  ~MpiMachines() override {
    // Until all are here what still comes is taken, for whoever has sent it waits for that.
    MPI_Request all_here = MPI_REQUEST_NULL;
    int here = ::MPI_Ibarrier(MPI_COMM_WORLD, &all_here) != MPI_SUCCESS;
    const auto until = std::chrono::steady_clock::now() + patience;
    while (!here && std::chrono::steady_clock::now() < until) {
      while (receive()) {
      }
      if (::MPI_Test(&all_here, &here, MPI_STATUS_IGNORE) != MPI_SUCCESS) break;
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    // Where one of them hangs or its machine is gone, nobody could end: then without a word, with the status that is its due.
    std::fflush(nullptr);
    std::signal(SIGALRM, [](int) { ::_exit(exit_status); });
    ::alarm(static_cast<unsigned>((here ? patience : patience_without_all).count()));
    ::MPI_Finalize();
    ::alarm(0);
  }
  int own_number() const override { return number_; }
  int count() const override { return count_; }

  void send(int to, Bytes bytes) override {
    wait_for_outgoing(most_outgoing);
    outgoing_.push_back({std::move(bytes), MPI_REQUEST_NULL});
    Outgoing& mail = outgoing_.back();
    if (::MPI_Isend(mail.bytes.data(), static_cast<int>(mail.bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD,
                    &mail.request) != MPI_SUCCESS)
      outgoing_.pop_back();
  }

  std::optional<Mail> receive() override {
    forget_sent();
    int there = 0;
    MPI_Status status{};
    if (::MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &there, &status) != MPI_SUCCESS || !there)
      return std::nullopt;
    int size = 0;
    ::MPI_Get_count(&status, MPI_BYTE, &size);
    Mail mail{status.MPI_SOURCE, Bytes(static_cast<std::size_t>(std::max(0, size)))};
    if (::MPI_Recv(mail.bytes.data(), size, MPI_BYTE, mail.from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE) != MPI_SUCCESS)
      return std::nullopt;
    return mail;
  }

  void will_end_with(int status) override { exit_status = status; }

 private:
  struct Outgoing {
    Bytes bytes;
    MPI_Request request;
  };

  void forget_sent() {
    for (auto mail = outgoing_.begin(); mail != outgoing_.end();) {
      int sent = 0;
      // An error means that whoever should have it is gone.
      if (::MPI_Test(&mail->request, &sent, MPI_STATUS_IGNORE) != MPI_SUCCESS || sent)
        mail = outgoing_.erase(mail);
      else
        ++mail;
    }
  }
  /// Until no more than `most` are on their way; not forever, for some may be to one that is gone.
  void wait_for_outgoing(std::size_t most) {
    const auto until = std::chrono::steady_clock::now() + patience;
    for (forget_sent(); outgoing_.size() > most && std::chrono::steady_clock::now() < until; forget_sent())
      std::this_thread::sleep_for(std::chrono::microseconds(200));
  }

  int number_ = 0, count_ = 1;
  std::list<Outgoing> outgoing_;
};

std::unique_ptr<Machines> start() { return std::make_unique<MpiMachines>(); }

}  // namespace

// Looked up by this name (start_machines), by C++ of the same build.
extern "C" {
extern const StartMachines septet_start_machines;
const StartMachines septet_start_machines = start;
}

}  // namespace septet::film
