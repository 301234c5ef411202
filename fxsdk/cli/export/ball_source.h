/// @file ball_source.h
/// Computes the media of a scene file at given times as a list of balls (spheres of medium).
#pragma once

#include "foundation/result/status.h"
#include "foundation/time/ticks.h"
#include "fxsdk/cli/scene/effect_scene.h"
#include "rendering/reference/render/medium_details.h"
#include "rendering/voxelization/voxel_ball.h"

#include <glm/vec3.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fx::cli {

struct MomentBalls
{
    std::vector<render::VoxelBall> balls;
    render::MediumDetails details; ///< of `balls`; without groups: none
    double anisotropy = 0.0; ///< [1] mean cosine of the scattering angle, weighted with what balls scatter
    uint32_t nonFinite = 0;  ///< number of balls omitted because a value was not finite
};

/// A simulation of the scene from its start.
class BallSource
{
public:
    virtual ~BallSource() = default;
    /// Simulates up to a time and returns the balls. @param tick time; must not decrease from call to call
    virtual base::Result<MomentBalls> at(base::Ticks tick) = 0;
};

/// A file that can be simulated any number of times.
class BallFile
{
public:
    virtual ~BallFile() = default;
    virtual base::Result<std::unique_ptr<BallSource>> start(const EffectSceneOptions& options) const = 0;
    /// [s] time of the preset's preview; empty if the preset does not state the time.
    virtual std::optional<double> previewTime() const { return std::nullopt; }
    /// Seed of the first instance; empty for a list of blobs.
    virtual std::optional<uint64_t> seed() const { return std::nullopt; }
    /// Warnings about the file.
    virtual std::vector<std::string> warnings() const { return {}; }
};

/// Opens a file. @param input *.scene.json, *.fx.json, library:NAME or *.blobs.csv
/// @return an error whose message names the file and the position in it
base::Result<std::unique_ptr<BallFile>> openBallFile(const std::string& input);

} // namespace fx::cli
