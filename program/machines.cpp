#include "program/machines.hpp"

#include <dlfcn.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "program/child_process.hpp"

namespace septet::program {
namespace {

std::optional<int> number_in(const char* variable) {
  const char* text = std::getenv(variable);
  int number = 0;
  if (!text || std::from_chars(text, text + std::strlen(text), number).ec != std::errc()) return std::nullopt;
  return number;
}

}  // namespace

std::optional<int> number_by_mpirun() {
  const auto count = number_in("OMPI_COMM_WORLD_SIZE"), number = number_in("OMPI_COMM_WORLD_RANK");
  return count && *count > 1 ? number : std::nullopt;
}

Expected<std::unique_ptr<Machines>> start_machines() {
  std::error_code ignored;
  auto file = own_folder() / "septet-mpi.so";  // In the build tree; else as installed.
  if (!std::filesystem::exists(file, ignored)) file = own_folder().parent_path() / "lib/septet/modules/septet-mpi.so";
  if (!std::filesystem::exists(file, ignored))
    return failure("this Septet was built without Open MPI", "mpirun",
                   "install the package libopenmpi-dev and build again, or leave mpirun out");
  // Its parts are modules that look for its functions in the whole program. It stays loaded.
  void* module = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  void* start = module ? ::dlsym(module, "septet_start_machines") : nullptr;
  if (!start) {
    const char* reason = ::dlerror();
    return failure(reason ? reason : "not a module of this Septet", file.string(),
                   "install the package libopenmpi3, or leave mpirun out");
  }
  return (*static_cast<const StartMachines*>(start))();
}

Expected<std::filesystem::path> find_mpirun(const std::string& option) {
  const auto mpirun = find_program("mpirun");
  if (!mpirun)
    return failure("there is no mpirun, which starts the programs", option,
                   "install the package openmpi-bin, or leave --ranks and --hosts out");
  const auto is_set = [](const char* name) { return std::getenv(name) != nullptr; };
  if (::geteuid() == 0 && !(is_set("OMPI_ALLOW_RUN_AS_ROOT") && is_set("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM")))
    return failure("mpirun does not work for root", option,
                   "run it as another user, or set OMPI_ALLOW_RUN_AS_ROOT=1 and OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1");
  return *mpirun;
}

std::vector<std::string> mpirun_arguments(unsigned ranks, const std::filesystem::path& hosts) {
  std::vector<std::string> arguments{"--enable-recovery", "--oversubscribe", "--bind-to", "none"};
  if (ranks > 0)
    arguments.insert(arguments.end(), {"-n", std::to_string(ranks)});
  else
    arguments.insert(arguments.end(), {"--npernode", "1"});
  if (!hosts.empty()) arguments.insert(arguments.end(), {"--hostfile", hosts.string()});
  return arguments;
}

unsigned share_of_processors() {
  cpu_set_t all;
  CPU_ZERO(&all);
  const long there = std::clamp(::sysconf(_SC_NPROCESSORS_CONF), 1l, static_cast<long>(CPU_SETSIZE));
  for (long n = 0; n < there; ++n) CPU_SET(static_cast<std::size_t>(n), &all);
  ::sched_setaffinity(0, sizeof(all), &all);  // Within what the system lets it have.
  if (::sched_getaffinity(0, sizeof(all), &all) != 0) return 1;
  const int beside = std::max(1, number_in("OMPI_COMM_WORLD_LOCAL_SIZE").value_or(1));
  return static_cast<unsigned>(std::max(1, CPU_COUNT(&all) / beside));
}

}  // namespace septet::program
