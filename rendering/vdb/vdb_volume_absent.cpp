/// @file vdb_volume_absent.cpp
/// The interface of the module where OpenVDB is not installed.

#include "rendering/vdb/vdb_volume.h"

namespace fx::render {

struct VdbVolume::Grids
{};

std::string vdbVersion()
{
    return {};
}

base::Status checkVdb()
{
    return {base::Code::NotFound,
            "this fx was built without OpenVDB, which reads and writes *.vdb: apt-get install "
            "libopenvdb-dev libboost-dev, then configure and build fx again"};
}

VdbVolume::VdbVolume(double) {}
VdbVolume::~VdbVolume() = default;
void VdbVolume::add(std::span<const VoxelBlock>) {}
void VdbVolume::addPoints(std::span<const VoxelBall>, bool) {}

uint64_t VdbVolume::voxels() const
{
    return 0;
}

base::Result<std::string> VdbVolume::encode(const VdbMetadata&, bool) const
{
    return checkVdb();
}

} // namespace fx::render
