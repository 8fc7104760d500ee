/// septet-mpi.so: the only place that knows Open MPI.
///
/// Only the start waits for other programs: a lost worker delays nobody. Messages are kept until they are sent. At the
/// end all wait for each other, for a while: mpirun takes a program that ends otherwise for a failed one.

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <list>
#include <thread>

#include "program/machines.hpp"

namespace septet::program {
namespace {

constexpr int tag = 15;
constexpr std::size_t most_outgoing = 256;
constexpr std::chrono::seconds patience{10}, patience_without_all{1};

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
    // Until all are here, arriving messages are received, since their senders wait for that.
    MPI_Request all_here = MPI_REQUEST_NULL;
    int here = ::MPI_Ibarrier(MPI_COMM_WORLD, &all_here) != MPI_SUCCESS;
    const auto until = std::chrono::steady_clock::now() + (has_losses() ? patience_without_all : patience);
    while (!here && std::chrono::steady_clock::now() < until) {
      while (receive()) {
      }
      if (::MPI_Test(&all_here, &here, MPI_STATUS_IGNORE) != MPI_SUCCESS) break;
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    // If one of them hangs or its machine is gone, no program could end: then exit silently, with the due status.
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
    begin_to_receive();
    for (auto mail = incoming_.begin(); mail != incoming_.end(); ++mail) {
      // Earlier messages from the same sender come first.
      if (std::any_of(incoming_.begin(), mail, [&](const Incoming& other) { return other.from == mail->from; }))
        continue;
      int came = 0;
      const bool failed = ::MPI_Test(&mail->request, &came, MPI_STATUS_IGNORE) != MPI_SUCCESS;
      if (!failed && !came) continue;
      Mail whole{mail->from, std::move(mail->bytes)};
      incoming_.erase(mail);
      if (failed) return std::nullopt;
      return whole;
    }
    return std::nullopt;
  }

  void will_end_with(int status) override { exit_status = status; }

 private:
  struct Outgoing {
    Bytes bytes;
    MPI_Request request;
  };
  /// A large message arrives piece by piece; it stays incomplete if the sender dies, which must block nobody.
  struct Incoming {
    int from;
    Bytes bytes;
    MPI_Request request;
  };

  void begin_to_receive() {
    int there = 0;
    MPI_Status status{};
    while (::MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &there, &status) == MPI_SUCCESS && there) {
      int size = 0;
      ::MPI_Get_count(&status, MPI_BYTE, &size);
      incoming_.push_back({status.MPI_SOURCE, Bytes(static_cast<std::size_t>(std::max(0, size))), MPI_REQUEST_NULL});
      Incoming& mail = incoming_.back();
      if (::MPI_Irecv(mail.bytes.data(), size, MPI_BYTE, mail.from, tag, MPI_COMM_WORLD, &mail.request) != MPI_SUCCESS)
        incoming_.pop_back();
    }
  }

  void forget_sent() {
    for (auto mail = outgoing_.begin(); mail != outgoing_.end();) {
      int sent = 0;
      // An error means that the receiver is gone.
      if (::MPI_Test(&mail->request, &sent, MPI_STATUS_IGNORE) != MPI_SUCCESS || sent)
        mail = outgoing_.erase(mail);
      else
        ++mail;
    }
  }
  /// Until at most `most` are on their path; bounded, since some may go to a lost program.
  void wait_for_outgoing(std::size_t most) {
    const auto until = std::chrono::steady_clock::now() + patience;
    for (forget_sent(); outgoing_.size() > most && std::chrono::steady_clock::now() < until; forget_sent())
      std::this_thread::sleep_for(std::chrono::microseconds(200));
  }

  int number_ = 0, count_ = 1;
  std::list<Outgoing> outgoing_;
  std::list<Incoming> incoming_;
};

std::unique_ptr<Machines> start() { return std::make_unique<MpiMachines>(); }

}  // namespace

// Looked up by this name (start_machines), by C++ of the same build.
extern "C" {
extern const StartMachines septet_start_machines;
const StartMachines septet_start_machines = start;
}

}  // namespace septet::program
