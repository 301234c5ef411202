/// @file volume_voxels.h
/// Voxels of the volumes of a view on the GPU.
#pragma once

#include "rendering/field/field_volume_pass.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_device.h"
#include "rendering/volumes/medium_volume.h"

#include <cstdint>
#include <memory>
#include <memory_resource>
#include <vector>

namespace fx::base {
class AssetTable;
}

namespace fx::render {

/// Keeps the volumes that frames show, and their coarser levels, each made when a frame first needs it.
/// Threads: [GL thread].
class VolumeVoxels
{
public:
    explicit VolumeVoxels(GlDevice& device, std::pmr::memory_resource* memory)
        : device_(device), volumes_(memory)
    {}

    /// Forgets volumes that no frame has asked for since 300 frames. Called once per frame, before
    /// find().
    void beginFrame();
    /// The medium of an asset; null if the table has no volume with this id, or if the driver cannot read its
    /// voxels from one buffer.
    const MediumVolume* find(const base::AssetTable* assets, uint32_t asset);
    /// Uploads a level of a volume that find() has returned. @return OutOfMemory, TooLarge
    base::Status makeRoom(uint32_t asset, int level);
    /// Sets index, voxels and their numbers of a level for which makeRoom() has been called.
    void import(FrameGraph& graph, uint32_t asset, int level, FieldVolumePass::Inputs& io) const;
    /// [cd/m3] Light of voxels of a level that is stored as 1.
    float brightest(uint32_t asset, int level) const;

    void release(); ///< deletes everything; volumes are made again when they are needed
    uint64_t bytes() const;

private:
    struct Level
    {
        std::unique_ptr<MediumVolume> medium;
        GlBuffer index, voxels;
    };
    struct Volume
    {
        uint32_t asset = 0;
        uint32_t unused = 0; ///< number of frames since the last find()
        std::vector<Level> levels = {};
    };
    const Level& levelOf(uint32_t asset, int level) const;
    size_t mostBricks() const;

    GlDevice& device_;
    std::pmr::vector<Volume> volumes_;
};

} // namespace fx::render
