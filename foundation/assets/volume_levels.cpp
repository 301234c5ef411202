#include "foundation/assets/volume_levels.h"

namespace fx::base {

uint64_t VolumeLevels::bytes() const
{
    uint64_t sum = 0;
    for (const VolumeLevel& level : coarser)
        sum +=
            level.voxels.size() * sizeof(VolumeLevel::Packed) + level.index.table().size() * sizeof(uint32_t);
    return sum;
}

} // namespace fx::base
