#pragma once
/// An elastic body to bytes and back (engine/core/archive.hpp). Its material is the caller's to keep; data that follows
/// from the elements is derived again.

#include "engine/core/archive.hpp"
#include "engine/physics/elastic/elastic_body.hpp"

namespace septet::elastic {

void save_body(const ElasticBody& body, StateWriter& writer);
void add_to_hash(const ElasticBody& body, StateHash& hash);

/// Restores a body of `body.material` and of no more than `most_elements`. `reader` fails on invalid data: then `body`
/// is not to be used.
void restore_body(StateReader& reader, std::size_t most_elements, ElasticBody& body);

}  // namespace septet::elastic
