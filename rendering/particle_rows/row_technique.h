/// @file row_technique.h
/// Conversion of groups of one kind of snapshot data to rows of particles, for sprites, ribbons and particles
/// on the GPU.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/passes/particle_batch.h"

#include <array>
#include <cstdint>
#include <span>

namespace fx::render {

/// A row approximated by a rectangle that faces the camera.
struct RowCard
{
    glm::vec3 center; ///< [m] position in the space of the group
    float area;       ///< [m2] area of the rectangle; 0: the row is not drawn
};

/// A ball of medium that represents several rows, in the space of the group.
struct RowBall
{
    uint32_t row = 0;          ///< index of the row at the center of the ball
    glm::vec3 center{0.0f};    ///< [m] center of the row
    float radius = 0.0f;       ///< [m] radius of the row
    float ownSection = 0.0f;   ///< [m2] extinction cross section of the row; 0: the row casts no shadow
    float crossSection = 0.0f; ///< [m2] total extinction cross section of all represented rows
};

/// Columns that are transformed when rows of several groups are merged into one group.
struct RowMerge
{
    static constexpr size_t kNone = ~size_t(0);

    size_t radius; ///< column of the radius [m], 0 in empty rows
    /// First of the three columns of the velocity; velocities are rotated with the group.
    size_t velocity = kNone;
    size_t orientation = kNone; ///< first of the four columns of the orientation
    /// Column of the strip number. Strip numbers are changed, so that different groups have different strip
    /// numbers.
    size_t strip = kNone;
    base::ColumnSet copied; ///< columns that are copied without transformation, including the strip number
};

struct RowTechnique
{
    const base::KindDesc* kind;
    /// True: rows are points of strips. Pieces between two points are drawn, and rows are not matched with
    /// older rows.
    bool isStrip;
    bool isComputed;                           ///< true: the GPU computes the rows from the data of the group
    std::span<const base::ColumnDesc> columns; ///< columns of the rows
    base::ColumnSet drawnColumns;              ///< columns that shaders read

    bool (*isThere)(const base::SnapshotGroup& group); ///< returns true if the group has rows to draw
    BatchShape (*shape)(const base::SnapshotGroup& group);
    uint32_t (*rows)(const base::SnapshotGroup& group);
    /// Returns the card of a row, for the estimate of fragments. For strips, the row must not be the last
    /// row of the group.
    RowCard (*card)(const base::SnapshotGroup& group, size_t row);
    base::Bounds (*bounds)(const base::SnapshotGroup& group); ///< computes bounds for a group without bounds
    /// The columns to transform when groups are merged; the first three columns are positions. Null: groups
    /// are not merged.
    const RowMerge* merge = nullptr;
    /// Returns a ball that casts the shadow of `count` drawn elements, from index `first` on. Null: groups
    /// cast no shadow.
    RowBall (*ball)(const base::SnapshotGroup& group, uint32_t first, uint32_t count) = nullptr;

    /// Number of drawn elements of a group: rows, or pieces of strips between two rows.
    uint32_t instances(const base::SnapshotGroup& group) const { return rows(group) - (isStrip ? 1u : 0u); }
};

/// Finds the technique that draws a kind of snapshot data.
class RowTechniques
{
public:
    static constexpr size_t kMax = 8;

    /// @param techniques techniques, which must stay valid; at most kMax techniques are used
    RowTechniques(std::span<const RowTechnique* const> techniques, const base::SnapshotSchema& schema)
        : techniques_(techniques.first(techniques.size() < kMax ? techniques.size() : kMax))
    {
        for (size_t i = 0; i < techniques_.size(); ++i)
            kinds_[i] = schema.find(techniques_[i]->kind->name);
    }

    /// Returns the technique of a kind, or null if the kind has no rows.
    const RowTechnique* of(base::KindId kind) const
    {
        for (size_t i = 0; i < techniques_.size(); ++i)
            if (kinds_[i] == kind && kind != base::kNoKind)
                return techniques_[i];
        return nullptr;
    }

private:
    std::span<const RowTechnique* const> techniques_;
    std::array<base::KindId, kMax> kinds_{};
};

} // namespace fx::render
