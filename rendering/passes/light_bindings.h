/// @file light_bindings.h
/// Where draws find the lights of a view; shaders/shared/light_slices.glsl reads them.
#pragma once

#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

constexpr uint32_t kLightBufferBinding = 5; ///< storage buffer of lights
constexpr uint32_t kLightSliceUnit = 7;     ///< texture unit of the planes

struct LightBindings
{
    ResourceId lights;   ///< buffer; invalid: nothing is lit
    ResourceId planes;   ///< R32F optical depths; invalid: media cast no shadow
    bool hasSky = false; ///< there are planes for the light of the sky

    void read(FrameGraph::Builder& builder) const
    {
        if (lights.valid())
            builder.read(lights);
        if (planes.valid())
            builder.read(planes);
    }
    BufferBinding bufferBinding() const { return {kLightBufferBinding, lights}; }
    TextureBinding textureBinding() const { return {kLightSliceUnit, planes, Sampling::Linear}; }
};

} // namespace fx::render
