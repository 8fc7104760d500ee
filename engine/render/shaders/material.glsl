// Material of one draw.

#include "engine/light/microfacets.hpp"
#include "engine/light/records.hpp"

layout(push_constant) uniform Material { MaterialConstants material; };
