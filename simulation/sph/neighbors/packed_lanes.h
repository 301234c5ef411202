/// @file packed_lanes.h
/// Permutations that move the selected lanes of a vector to its beginning.
#pragma once

#include <array>
#include <cstdint>

namespace fx::sim {

using PackedLanes = std::array<std::array<uint32_t, 8>, 256>;

constexpr PackedLanes packedLanes()
{
    PackedLanes table{};
    for (uint32_t bits = 0; bits < 256; ++bits) {
        uint32_t slot = 0;
        for (const uint32_t kept : {1u, 0u})
            for (uint32_t lane = 0; lane < 8; ++lane)
                if ((bits >> lane & 1) == kept)
                    table[bits][slot++] = lane;
    }
    return table;
}

/// Table of permutations. Row `bits` contains first the lanes whose bit is set, in ascending order, then the
/// other lanes. For vectors of n lanes, only the first n numbers of the rows below 2^n are used.
alignas(64) inline constexpr PackedLanes kPackedLanes = packedLanes();

} // namespace fx::sim
