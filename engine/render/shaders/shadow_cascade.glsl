// Cascade that is drawn.

#include "engine/light/records.hpp"

layout(push_constant) uniform Cascade { CascadeConstants cascade; };
