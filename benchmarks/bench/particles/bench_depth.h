/// @file bench_depth.h
/// Depth texture for the collisions of fx bench particles --gpu in its second measurement.
#pragma once

#include "rendering/gl/gl_texture.h"
#include "rendering/gpu_particles/gpu_depth.h"

namespace fx::cli {

/// A slope that rises beside the emitter and that a camera sees from 13 m, 1280 x 720.
class BenchDepth
{
public:
    static base::Result<BenchDepth> create(render::GlDevice& device);

    /// Valid while this lives.
    render::GpuDepth in(render::FrameGraph& graph) const;

private:
    render::CameraView camera_;
    render::GlTexture distance_; ///< as SceneDistancePass writes it
};

} // namespace fx::cli
