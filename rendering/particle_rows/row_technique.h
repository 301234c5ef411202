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

/// A row as a rectangle across the view.
struct RowCard
/// [m] in the group's axes
{
    glm::vec3 center;
    float area; ///< [m2]; 0: nothing is drawn
};

/// Some rows as one ball of medium, in the group's axes.
struct RowBall
{
    uint32_t row = 0;          ///< that represents all
    glm::vec3 center{0.0f};    ///< [m] of that row
    float radius = 0.0f;       ///< [m] of that row
    float ownSection = 0.0f;   ///< [m2] extinction cross section of that row; 0: none takes light
    float crossSection = 0.0f; ///< [m2] of all
};

/// Columns that are transformed when rows of several groups are merged into one group.
struct RowMerge
{
    static constexpr size_t kNone = ~size_t(0);

    size_t radius;              ///< column [m], 0 in rows that are not used
    size_t velocity = kNone;    ///< first of three columns, which turn with the group
    size_t orientation = kNone; ///< first of four columns of the orientation
    size_t strip = kNone;       ///< column of strip numbers, which are made different between groups
    base::ColumnSet copied;     ///< columns that are the same in any space, strip numbers among them
};

struct RowTechnique
{
    const base::KindDesc* kind;
    /// Rows are points of strips, drawn as pieces between two points; not matched with older rows.
    bool isStrip;
    bool isComputed;                           ///< the GPU computes the rows from the data of the group
    std::span<const base::ColumnDesc> columns; ///< of the rows
    base::ColumnSet drawnColumns;              ///< those that drawing reads

    bool (*isThere)(const base::SnapshotGroup& group); ///< whether a group has something to draw
    BatchShape (*shape)(const base::SnapshotGroup& group);
    uint32_t (*rows)(const base::SnapshotGroup& group);
    /// Size of a row's card, to estimate fragments; the row is not the last of a strip's group.
    RowCard (*card)(const base::SnapshotGroup& group, size_t row);
    base::Bounds (*bounds)(const base::SnapshotGroup& group); ///< of rows whose writer has given none
    /// Places are the first three columns. Null: groups of the kind are not merged.
    const RowMerge* merge = nullptr;
    /// A ball that casts the shadow of `count` instances from `first` on. Null: no shadow.
    RowBall (*ball)(const base::SnapshotGroup& group, uint32_t first, uint32_t count) = nullptr;

    /// Number of drawn elements of a group: rows, or pieces between them.
    uint32_t instances(const base::SnapshotGroup& group) const { return rows(group) - (isStrip ? 1u : 0u); }
};

/// Techniques by the kinds of one schema.
class RowTechniques
{
public:
    static constexpr size_t kMax = 8;

    /// @param techniques at most kMax are used; must stay
    RowTechniques(std::span<const RowTechnique* const> techniques, const base::SnapshotSchema& schema)
        : techniques_(techniques.first(techniques.size() < kMax ? techniques.size() : kMax))
    {
        for (size_t i = 0; i < techniques_.size(); ++i)
            kinds_[i] = schema.find(techniques_[i]->kind->name);
    }

    /// Null: the kind is none of rows.
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
