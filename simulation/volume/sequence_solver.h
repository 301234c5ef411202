/// @file sequence_solver.h
/// A medium on voxels that is played from a sequence of volumes. What is shown depends on the time alone.
#pragma once

#include "foundation/assets/asset_table.h"
#include "foundation/assets/volume_sequence.h"
#include "simulation/detail/field_detail.h"
#include "simulation/solver/sequence_time.h"
#include "simulation/solver/still_medium.h"

#include <memory>
#include <vector>

namespace fx::sim {

struct SequenceDef final : StillMediumDef
{
    std::shared_ptr<base::VolumeSequence> sequence;
    base::AssetId asset = 0; ///< id of `sequence` in the asset table
    float framesPerSecond = 24.0f;
    SequenceEnd end = SequenceEnd::Hold;
    uint32_t mostCells = 0; ///< of any two successive steps
    FieldDetail detail;     ///< fixed in space, while the medium moves through it

    /// Sets `sequence` and `mostCells`.
    void setSequence(std::shared_ptr<base::VolumeSequence> frames);

    /// With a sequence only.
    SequenceTime time() const { return {sequence->count(), framesPerSecond, end}; }

    std::unique_ptr<Solver> create(const base::SnapshotSchema& schema, const Quality& quality,
                                   std::pmr::memory_resource* memory) const override;
    uint32_t capacity() const override { return mostCells; }
    bool startsInMotion() const override { return true; }
    bool publishes(const base::KindDesc& kind) const override;
    uint64_t bytes() const override; ///< with the voxels that are held
    float reach(float gravity, float wind, float seconds) const override;
};

} // namespace fx::sim
