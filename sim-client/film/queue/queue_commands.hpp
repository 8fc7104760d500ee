#pragma once
/// `septet film queue`, `status` and `cancel`.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::film {

struct QueueArguments {
  std::filesystem::path folder;        ///< Folder of the queue; empty: the default one.
  std::vector<std::string> film;       ///< Words of a film's command line; empty: only go on with those that wait.
  bool make = false;                   ///< Make the films in this program.
  std::vector<std::uint64_t> numbers;  ///< Films to cancel.
};

/// Adds a film, if one is given, and makes sure that a program makes those that wait. `out`: of that film.
Expected<int> queue_film(const QueueArguments& arguments, const std::filesystem::path& out);
Expected<int> show_queue(const QueueArguments& arguments);
Expected<int> cancel_films(const QueueArguments& arguments);

}  // namespace septet::film
