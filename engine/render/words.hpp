#pragma once
/// The rasteriser speaks the words of the description that it draws: engine/instant.

namespace septet::instant {}

namespace septet::render {
using namespace instant;
}
