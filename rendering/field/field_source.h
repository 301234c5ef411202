/// @file field_source.h
/// The sum of all fields of a view in the media pass: marched front to back, one rectangle a part of the
/// window in which fields are seen.
#pragma once

#include "rendering/draw_order/draw_batcher.h"
#include "rendering/field/field_textures.h"
#include "rendering/passes/media_source.h"

#include <array>

namespace fx::render {

/// With light sorted by layer, or not; with detail, or not.
const ProgramDesc& fieldMarchProgram(bool layers, bool detail);

/// Draws the fields as a stream of shells around the eye, farthest first, so that what is no field is drawn
/// between them by its distance. Neighboring shells are marched through in one go: then there is one sequence
/// of steps through the sum of all fields, and no order.
class FieldSource final : public MediaSource
{
public:
    static constexpr uint32_t kShells = 16;

    /// @param nearest, farthest [m] between which there is medium
    void placeShells(float nearest, float farthest);
    DrawStream stream() const;

    void read(FrameGraph::Builder& builder) const override;
    void draw(Backend& backend, const DrawBatch& batch, const MediaTarget& target) const override;

    FieldTextures textures;
    ResourceId fields, table, tiles, tileFields; ///< buffers of what FieldPlan lists
    ResourceId details;                          ///< buffer of FieldDetailBlock; invalid: no field has detail
    ResourceId lumpTile;                         ///< periodic cube of lumps, R32F
    uint32_t tileCount = 0;

private:
    std::array<float, kShells + 1> edges_{}; ///< [m] farthest first
    std::array<float, kShells> middles_{};   ///< [m]
    std::array<uint32_t, kShells> order_{};
};

} // namespace fx::render
