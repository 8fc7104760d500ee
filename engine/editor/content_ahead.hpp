#pragma once
/// Shapes, materials and pictures that a batch makes, apart from what shows them: one batch holds 2 MiB and 4,096 commands, a
/// model with its pictures more; nor does it let shapes grow by more than 4 MiB. They go ahead in batches of their own, of which
/// nothing is seen; the rest is one batch, at one tick.

#include <cstddef>
#include <span>
#include <vector>

#include "engine/scene/command.hpp"

namespace septet::editor {

struct SplitBatch {
  std::vector<std::vector<scene::Command>> ahead;  ///< Each within a batch's bytes, commands and growth.
  std::vector<scene::Command> rest;
  std::vector<std::size_t> rest_from;  ///< Of each of `rest` its place in the batch.
};

/// `ahead` is empty where the batch is small enough as it is.
SplitBatch split_content(std::span<const scene::Command> batch);

}  // namespace septet::editor
