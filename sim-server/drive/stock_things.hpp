#pragma once
/// What the world has that can stand in it once more: the catalogue's vehicles, and each look of the objects beside the
/// roads. An editor's line `like NAME NODE …` (docs/editing.md) places one.

#include <string_view>
#include <vector>

#include "engine/scene/store.hpp"
#include "sim-server/page/placing_view.hpp"

namespace septet::server {

/// The first part of a generated object's name, "tree" of "tree/412.5/-81.0".
std::string_view kind_of_object(std::string_view name);
/// True for kinds of single things that stand at a place of their own; land, lanes and what runs along them are none.
bool is_single_thing(std::string_view kind);

/// By kind, then by name; a kind with very many looks, as of houses, is represented by some. `generated`: the world
/// before any edit.
std::vector<page::StockThing> stock_things(const scene::Store& generated);

}  // namespace septet::server
