/// @file bench_depth.h
/// Depth texture for the collisions of the second measurement of fx bench particles --gpu.
#pragma once

#include "rendering/gl/gl_texture.h"
#include "rendering/gpu_particles/gpu_depth.h"

namespace fx::cli {

/// Depth texture of a slope beside the emitter, seen by a camera at a distance of 13 m, 1280 x 720 pixels.
class BenchDepth
{
public:
    static base::Result<BenchDepth> create(render::GlDevice& device);

    /// Adds the texture to a graph. The result is valid during the lifetime of this object.
    render::GpuDepth in(render::FrameGraph& graph) const;

private:
    render::CameraView camera_;
    render::GlTexture distance_; ///< distances in the format of SceneDistancePass
};

} // namespace fx::cli
