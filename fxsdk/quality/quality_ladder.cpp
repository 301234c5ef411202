#include "fxsdk/quality/quality_ladder.h"

#include <algorithm>

namespace fx::quality {

void apply(const Knobs& knobs, render::ViewSettings& ioSettings)
{
    if (knobs.billboards)
        ioSettings.form = std::min(ioSettings.form, *knobs.billboards);
    if (knobs.detail)
        ioSettings.detail = ioSettings.detail && *knobs.detail;
    if (knobs.particles)
        ioSettings.particleShare = std::min(ioSettings.particleShare, *knobs.particles);
    if (knobs.shimmer && !*knobs.shimmer)
        ioSettings.shimmer.strength = 0.0f;
    if (knobs.lodBias)
        ioSettings.lod.bias = std::max(ioSettings.lod.bias, *knobs.lodBias);
    if (knobs.dazzle)
        ioSettings.dazzle.enabled = ioSettings.dazzle.enabled && *knobs.dazzle;
}

Knobs merged(const Knobs& first, const Knobs& second)
{
    Knobs both = second;
    both.billboards = first.billboards ? first.billboards : second.billboards;
    both.detail = first.detail ? first.detail : second.detail;
    both.particles = first.particles ? first.particles : second.particles;
    both.shimmer = first.shimmer ? first.shimmer : second.shimmer;
    both.lodBias = first.lodBias ? first.lodBias : second.lodBias;
    both.dazzle = first.dazzle ? first.dazzle : second.dazzle;
    return both;
}

} // namespace fx::quality
