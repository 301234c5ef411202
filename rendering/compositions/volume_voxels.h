/// @file volume_voxels.h
/// Voxels of the volumes of a view on the GPU.
#pragma once

#include "rendering/field/field_volume_pass.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/volumes/medium_volume.h"
#include "rendering/volumes/volume_place.h"

#include <cstdint>
#include <memory>
#include <memory_resource>
#include <optional>
#include <vector>

namespace fx::base {
class AssetTable;
class VolumeSequence;
} // namespace fx::base

namespace fx::render {

/// Voxels of a volume, or of a frame of a sequence.
struct VoxelsName
{
    uint32_t asset = 0; ///< id in the asset table
    uint32_t frame = 0; ///< of a sequence

    bool operator==(const VoxelsName&) const = default;
};

/// What a volume shows at a moment: a frame, or a moment between two.
struct ShownVoxels
{
    VoxelsName first, second;    ///< equal unless the moment is between two frames
    MediumVolume::Moment moment; ///< between both
    float largest = 0.0f;        ///< [1/m] upper bound of the extinction
    bool isFine = false;         ///< true: there are no coarser levels yet
};

/// Keeps the volumes that frames show on the GPU, each level from when a frame first needs it. Coarser levels
/// are made by the threads that read volumes, never here. Frames of sequences are forgotten soon after they
/// were shown.
/// Threads: [GL thread].
class VolumeVoxels
{
public:
    explicit VolumeVoxels(GlDevice& device, std::pmr::memory_resource* memory)
        : device_(device), volumes_(memory), small_(memory)
    {}

    /// Forgets volumes that no frame has asked for since 300 frames. Called once per frame, before
    /// find().
    void beginFrame();
    /// The voxels of a volume at its moment. Nothing if the table has neither a volume nor a sequence with
    /// its id, or if a frame of the sequence has not been read yet.
    /// Frames that will be shown next are read in advance.
    std::optional<ShownVoxels> find(const base::AssetTable* assets, const GroupVolume& volume);
    /// Has the coarser levels made of a sequence that find() has returned, also of the frames that follow.
    void wantCoarser(const base::AssetTable& assets, const ShownVoxels& voxels);
    /// Uploads a level of voxels that find() has returned. @return OutOfMemory
    base::Status makeRoom(const ShownVoxels& voxels, int level);
    /// Sets index, voxels and their numbers of a level for which makeRoom() has been called.
    void import(FrameGraph& graph, const ShownVoxels& voxels, int level, FieldVolumePass::Inputs& io) const;

    void release(); ///< deletes everything; volumes are made again when they are needed
    uint64_t bytes() const;

private:
    struct Level
    {
        glm::ivec3 low{0}, size{0}; ///< [brick] of the index
        uint32_t bricks = 0;
        float brightest = 1.0f; ///< [cd/m3]
        GlBuffer index;
        GlTexture voxels;
    };
    struct Volume
    {
        VoxelsName name;
        std::shared_ptr<base::VolumeSequence> sequence; ///< null: it is a single volume
        std::shared_ptr<const base::VoxelVolume> source;
        base::CoarserLevels coarser = nullptr; ///< null: not known
        float largest = 0.0f;                  ///< [1/m]
        uint32_t unused = 0;                   ///< number of frames since the last find()
        std::vector<Level> levels = {};
    };
    /// A sequence whose coarser levels are wanted.
    struct SmallSequence
    {
        uint32_t asset;
        uint32_t unused; ///< number of frames since the last wantCoarser()
    };
    Volume* find(VoxelsName name, const base::AssetTable& assets);
    Volume* known(VoxelsName name);
    base::Status makeRoom(VoxelsName name, int level);
    base::Status upload(const base::VolumeLevel& level, Level& out);
    const Level& levelOf(VoxelsName name, int level) const;

    GlDevice& device_;
    std::pmr::vector<Volume> volumes_;
    std::pmr::vector<SmallSequence> small_;
};

} // namespace fx::render
