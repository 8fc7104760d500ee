#include "sim-server/sumo/sumo_client.hpp"

#include <dlfcn.h>

#include "program/child_process.hpp"

namespace septet::server {

Expected<ConnectSumo> load_sumo_module() {
  std::error_code ignored;
  auto file = program::own_folder() / "septet-sumo.so";  // In the build tree; else as installed.
  if (!std::filesystem::exists(file, ignored))
    file = program::own_folder().parent_path() / "lib/septet/modules/septet-sumo.so";
  if (!std::filesystem::exists(file, ignored))
    return failure(
        "this Septet was built without SUMO's client library", "--traffic sumo",
        "build septet-sumo beside it (./run does, where the package sumo is installed), or drive with --traffic own");
  // Stays loaded: its objects may live as long as the program.
  void* module = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* connect = module ? ::dlsym(module, "septet_connect_sumo") : nullptr;
  if (!connect) {
    const char* reason = ::dlerror();
    return failure(reason ? reason : "not a module of this Septet", file.string(),
                   "install the package sumo, or drive with --traffic own");
  }
  return *static_cast<const ConnectSumo*>(connect);
}

}  // namespace septet::server
