/// @file ball_source.h
/// The balls of medium of a file at moments of its scene.
#pragma once

#include "foundation/result/status.h"
#include "foundation/time/ticks.h"
#include "fxsdk/cli/scene/effect_scene.h"
#include "rendering/voxelization/voxel_ball.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fx::cli {

struct MomentBalls
{
    std::vector<render::VoxelBall> balls;
    uint32_t nonFinite = 0; ///< left out because a number was not finite
};

/// One run from the start of the scene.
class BallSource
{
public:
    virtual ~BallSource() = default;
    /// @param tick must not decrease from call to call
    virtual base::Result<MomentBalls> at(base::Ticks tick) = 0;
};

/// A file that can be run any number of times.
class BallFile
{
public:
    virtual ~BallFile() = default;
    virtual base::Result<std::unique_ptr<BallSource>> start(const EffectSceneOptions& options) const = 0;
    /// [s] at which the preset's preview shows it, if it says so.
    virtual std::optional<double> previewTime() const { return std::nullopt; }
    /// Of the first instance; none: a list of blobs.
    virtual std::optional<uint64_t> seed() const { return std::nullopt; }
    /// Of the file.
    virtual std::vector<std::string> warnings() const { return {}; }
};

/// @param input *.scene.json, *.fx.json, library:NAME or *.blobs.csv
/// @return errors name file and place
base::Result<std::unique_ptr<BallFile>> openBallFile(const std::string& input);

} // namespace fx::cli
