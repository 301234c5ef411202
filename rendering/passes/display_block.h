/// @file display_block.h
/// Uniforms of passes that convert between the host's target and light.
#pragma once

#include "rendering/frame/view_types.h"

#include <algorithm>
#include <cstdint>

namespace fx::render {

/// Layout of shaders/frame/display_block.glsl.
struct DisplayBlock
{
    float white;     ///< [1] exposed radiance of effects that is displayed as 1, >= 1
    float target;    ///< TargetEncoding of the target
    float source;    ///< TargetEncoding of the texels that are read; Linear also for textures of sRGB formats
    float hostWhite; ///< [1] exposed radiance that the host has drawn as 1, from 1 to white
    int32_t x, y;    ///< [pixel] place of the frame in the target
    int32_t whole;   ///< 1: unchanged pixels are written as well
    int32_t unused2; ///< 0
};
static_assert(sizeof(DisplayBlock) == 32);

/// @param white values less than 1, and NaN, are replaced by 1
/// @param sourceIsLight true: OpenGL decodes the picture when it is read, as it has an sRGB format
inline DisplayBlock makeDisplayBlock(const HostTargets& targets, float white, bool sourceIsLight, bool whole)
{
    const float encoding = float(targets.encoding);
    return {white > 1.0f ? white : 1.0f,
            encoding,
            sourceIsLight ? 0.0f : encoding,
            std::clamp(targets.displayWhite, 1.0f, std::max(white, 1.0f)),
            targets.x,
            targets.y,
            whole ? 1 : 0,
            0};
}

} // namespace fx::render
