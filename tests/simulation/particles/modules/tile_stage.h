/// @file tile_stage.h
/// A single tile as input of modules, and an independent implementation of the free flight between modules.
#pragma once

#include "simulation/particles/tile.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <vector>

namespace fx::test {

class TileStage
{
public:
    explicit TileStage(uint32_t rows = 1)
        : tile(std::make_unique<sim::Tile>()), context{step, 0, glm::vec3(0.0f), 0.0, 0.0f}
    {
        std::memset(static_cast<void*>(tile.get()), 0, sizeof(sim::Tile));
        tile->count = rows;
        tile->padded = (rows + sim::kTilePadding - 1) / sim::kTilePadding * sim::kTilePadding;
        step.seed = 7;
        step.groundHeight = -std::numeric_limits<float>::infinity();
        for (uint32_t i = rows; i < sim::kTileRows; ++i)
            tile->flags[i] = sim::tile_flag::Empty;
    }

    void place(uint32_t i, const glm::vec3& position, const glm::vec3& velocity)
    {
        tile->x[i] = position.x;
        tile->y[i] = position.y;
        tile->z[i] = position.z;
        tile->vx[i] = velocity.x;
        tile->vy[i] = velocity.y;
        tile->vz[i] = velocity.z;
    }
    glm::vec3 position(uint32_t i = 0) const { return {tile->x[i], tile->y[i], tile->z[i]}; }
    glm::vec3 velocity(uint32_t i = 0) const { return {tile->vx[i], tile->vy[i], tile->vz[i]}; }
    glm::vec3 acceleration(uint32_t i = 0) const { return {tile->ax[i], tile->ay[i], tile->az[i]}; }
    glm::vec3 air(uint32_t i = 0) const { return {tile->ux[i], tile->uy[i], tile->uz[i]}; }

    /// Sets the sums of forces in the tile to 0, and sets the length of the next step.
    void begin(float seconds)
    {
        context.seconds = seconds;
        for (float* sum : {tile->ax, tile->ay, tile->az, tile->ux, tile->uy, tile->uz, tile->drag,
                           tile->quadratic, tile->contact})
            std::fill_n(sum, sim::kTileRows, 0.0f);
        for (uint32_t i = 0; i < sim::kTileRows; ++i) {
            tile->seconds[i] = i < tile->count ? seconds : 0.0f;
            tile->flags[i] &= sim::tile_flag::Stuck | sim::tile_flag::Collided | sim::tile_flag::Empty;
            tile->fromX[i] = tile->x[i];
            tile->fromY[i] = tile->y[i];
            tile->fromZ[i] = tile->z[i];
        }
    }
    void run(const sim::TileOp& op)
    {
        std::vector<std::byte> room(op.scratchBytes() + 64);
        void* scratch = room.data();
        size_t left = room.size();
        scratch = std::align(64, op.scratchBytes(), scratch, left);
        op.prepare(context, scratch);
        op.run(context, scratch, *tile);
    }
    /// Moves particles in free flight under gravity and the accelerations that modules have added.
    void fly(const glm::vec3& gravity = glm::vec3(0.0f))
    {
        for (uint32_t i = 0; i < tile->count; ++i) {
            if (tile->flags[i] & sim::tile_flag::Stuck)
                continue;
            const float t = tile->seconds[i];
            const glm::vec3 a = acceleration(i) + gravity, v = velocity(i);
            place(i, position(i) + t * v + 0.5f * t * t * a, v + t * a);
        }
        context.begin += double(context.seconds);
    }

    sim::StepContext step{};
    std::unique_ptr<sim::Tile> tile;
    sim::TileContext context;
};

} // namespace fx::test
