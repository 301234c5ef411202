#include "rendering/frame/exposure.h"

#include <cmath>

namespace fx::render {

float exposureFromEv100(float ev100)
{
    return 1.0f / (1.2f * std::exp2(ev100));
}

} // namespace fx::render
