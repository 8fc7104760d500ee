#pragma once
/// Names of the description that the rasteriser draws (engine/instant).

namespace septet::instant {}

namespace septet::render {
using namespace instant;
}
