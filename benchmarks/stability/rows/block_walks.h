/// @file block_walks.h
/// Blocks of an effect, walked through as a view does it, for the rows of blocks. No picture is drawn.
#pragma once

#include "foundation/snapshot/block_groups.h"
#include "rendering/blocks/block_walk.h"
#include "simulation/blocks/blocks_def.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <memory_resource>
#include <vector>

namespace fx::cli {

/// What a view draws of the blocks of an effect.
struct WalkedBlocks
{
    std::pmr::vector<render::GatheredBlob> balls; ///< balls, and impostors with their tile
    std::pmr::vector<render::MediumCaster> casters;
    std::pmr::vector<render::BlockRecord> records; ///< of the impostors
    size_t newTiles = 0;
    render::BlockWalkCounts counts;

    double section() const
    {
        double sum = 0.0;
        for (const render::GatheredBlob& ball : balls)
            sum += double(ball.crossSection);
        return sum;
    }
    /// Number of values of balls and records that are not finite.
    size_t broken() const
    {
        size_t count = 0;
        const auto add = [&](auto... value) { count += ((std::isfinite(value) ? 0u : 1u) + ...); };
        for (const render::GatheredBlob& b : balls)
            add(b.center.x, b.center.y, b.center.z, b.radius, b.crossSection, b.albedo.x, b.emission.x);
        for (const render::BlockRecord& r : records)
            add(r.right.x, r.right.y, r.right.z, r.right.w, r.up.x, r.up.y, r.up.z, r.up.w, r.tile.w);
        for (const render::MediumCaster& c : casters)
            add(c.center.x, c.center.y, c.center.z, c.radius, c.crossSection);
        return count;
    }
};

/// An effect of blocks, published once, and the tiles of a view of it.
class WalkedEffect
{
public:
    static constexpr int kHeight = 1080;          ///< [pixel] of the picture
    static constexpr float kTangent = 0.4142136f; ///< of half the field of view

    explicit WalkedEffect(const sim::BlocksDef& def) : snapshot_(&schema_, std::pmr::new_delete_resource())
    {
        for (const base::KindDesc* kind : {&base::kBlobKind, &base::kBlockKind, &base::kBlockBallKind})
            schema_.add(*kind);
        snapshot_.begin(0, 1);
        def.create(schema_, {}, std::pmr::new_delete_resource())->publish({}, snapshot_);
        groups_.emplace(snapshot_, snapshot_.addedCount() - 1);
        contents_.build(*groups_);
    }

    /// Walks through the blocks as seen by an eye at the origin that looks along -z.
    /// @param place [m] of the effect relative to the eye
    /// @param error [1] limit of the predicted error; 0: none. The exposure is 1 m2/cd
    WalkedBlocks walk(const glm::dvec3& place, float maxPixels, const render::TileSettings& tiles = {},
                      float error = 0.0f)
    {
        WalkedBlocks out;
        render::CameraGeometry camera{};
        camera.right = {1, 0, 0};
        camera.up = {0, 1, 0};
        camera.forward = {0, 0, -1};
        camera.nearDistance = 1e-3f;
        camera.clipScale = glm::vec2(1.0f / kTangent);
        tiles_.begin(tiles);
        errors_.begin(false);
        render::BlockWalk walk(camera, kHeight, tiles_, out.balls, out.casters, out.records);
        render::BlockWalkSettings settings;
        settings.maxPixels = maxPixels;
        settings.error = error;
        settings.errors = &errors_;
        settings.maxBalls = std::numeric_limits<uint32_t>::max() / 2;
        base::Placement placement;
        placement.position = place;
        walk.run(*groups_, contents_, nullptr, 1.0f, 0.0f, 0.0, placement, {}, {}, settings);
        out.newTiles = tiles_.jobs().size();
        out.counts = walk.counts();
        return out;
    }

    /// [m] Distance from which a ball of radius 1 m has this diameter on the picture.
    static double distanceOf(double pixels) { return double(kHeight) / (double(kTangent) * pixels); }
    const render::BlockContent& content(uint32_t type) const
    {
        return contents_.of(base::variantOf(type, 0));
    }
    std::pmr::vector<render::BlockBall> ballsOf(uint32_t type) const
    {
        std::pmr::vector<render::BlockBall> balls;
        contents_.balls(base::variantOf(type, 0), balls);
        return balls;
    }

private:
    base::SnapshotSchema schema_;
    base::FrameSnapshot snapshot_;
    std::optional<base::BlockGroups> groups_;
    render::BlockContents contents_{std::pmr::new_delete_resource()};
    render::BlockErrors errors_{std::pmr::new_delete_resource()};
    render::BlockTiles tiles_{std::pmr::new_delete_resource()};
};

} // namespace fx::cli
