/// A bad network for a whole program: preloaded (LD_PRELOAD), it loses a share of the datagrams that the program sends and
/// of those that it receives, each by itself, by a seeded generator.
///
///     LD_PRELOAD=septet-lossy.so SEPTET_LOST_PER_MILLE=50 SEPTET_LOSS_SEED=1 septet-server …
///
/// Of UdpSocket's two calls alone; what is lost was sent, for the sender. Threads may call at once.

#include <dlfcn.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <random>

namespace {

unsigned number_of(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? 0U : static_cast<unsigned>(std::strtoul(text, nullptr, 10));
}

bool is_lost() {
  static const unsigned lost_per_mille = number_of("SEPTET_LOST_PER_MILLE");
  static std::mutex turn;
  static std::mt19937 random(number_of("SEPTET_LOSS_SEED"));
  const std::scoped_lock lock(turn);
  return random() % 1000 < lost_per_mille;
}

/// The call of the C library that this one stands before.
template <typename Call>
Call behind(const char* name) {
  return reinterpret_cast<Call>(::dlsym(RTLD_NEXT, name));
}

/// Puts a received datagram into the slot of a lost one.
void put_into(mmsghdr& slot, const mmsghdr& received) {
  const msghdr& from = received.msg_hdr;
  msghdr& to = slot.msg_hdr;
  std::memcpy(to.msg_iov->iov_base, from.msg_iov->iov_base, received.msg_len);
  std::memcpy(to.msg_name, from.msg_name, from.msg_namelen);
  std::memcpy(to.msg_control, from.msg_control, from.msg_controllen);
  to.msg_namelen = from.msg_namelen;
  to.msg_controllen = from.msg_controllen;
  to.msg_flags = from.msg_flags;
  slot.msg_len = received.msg_len;
}

}  // namespace

extern "C" int sendmmsg(int socket, mmsghdr* datagrams, unsigned count, int flags) {
  using Call = int (*)(int, mmsghdr*, unsigned, int);
  static const Call send = behind<Call>("sendmmsg");
  for (unsigned i = 0; i < count; ++i) {
    if (is_lost()) continue;
    if (const int sent = send(socket, datagrams + i, 1, flags); sent <= 0) return i > 0 ? static_cast<int>(i) : sent;
  }
  return static_cast<int>(count);
}

extern "C" int recvmmsg(int socket, mmsghdr* datagrams, unsigned count, int flags, timespec* timeout) {
  using Call = int (*)(int, mmsghdr*, unsigned, int, timespec*);
  static const Call receive = behind<Call>("recvmmsg");
  const int received = receive(socket, datagrams, count, flags, timeout);
  int kept = 0;
  for (int i = 0; i < received; ++i) {
    if (is_lost()) continue;
    if (kept < i) put_into(datagrams[kept], datagrams[i]);
    ++kept;
  }
  if (received <= 0 || kept > 0) return received <= 0 ? received : kept;
  // None is left: the next wait tells of what comes.
  errno = EAGAIN;
  return -1;
}
