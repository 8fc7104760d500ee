#pragma once
/// Numbers gone bad.

#include "engine/physics/elastic/elastic_body.hpp"

namespace septet::elastic {

/// Resets nodes with non-finite numbers to their rest place in the body's mean motion; returns their number. A step
/// ends with it; call it after moving nodes elsewhere, too.
int reset_bad_nodes(ElasticBody& body);

}  // namespace septet::elastic
