/// @file gathered_blob.h
/// A blob as gathered from snapshots.
#pragma once

#include "foundation/math/hash.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace fx::render {

/// A blob relative to the eye, before lighting.
struct GatheredBlob
{
    glm::vec3 center;     ///< [m] position relative to the eye, along world axes
    float radius;         ///< [m] > 0
    float crossSection;   ///< [m2] > 0
    float temperature;    ///< [K]
    glm::vec3 albedo;     ///< [1]
    glm::vec3 emission;   ///< [cd/m2] emission in addition to black-body emission
    glm::vec3 tint{1.0f}; ///< [1] factor of black-body emission
    float fireShare;      ///< [1]
    float heat;           ///< [K]
    float seed;           ///< [0, 1) seed of procedural detail, computed from the id of the blob
    float rank;           ///< [0, 1) see BlobInstance::layer
    float detailAmount;   ///< [1]
    float detailScale;    ///< [1]
    float anisotropy;     ///< [1]
    uint32_t layer;       ///< MediaLayer
    int detail = -1;      ///< index of the detail of its group; -1: no detail
    /// Number of the tile + 1 that the extinction of the blob follows instead of the kernel; 0: the kernel.
    uint32_t tile = 0;
    glm::vec3 velocity{0.0f}; ///< [m/s] velocity relative to the world
    /// [cell] Offsets of the noise coordinates, see BlobDetail::carried().
    std::array<glm::vec3, 2> carried{};
};

/// [0, 1) Seed of the procedural detail of a blob.
/// @param id identity of the blob
inline float detailSeed(uint64_t id)
{
    const uint64_t x = (id ^ (id >> 29)) * 0xBF58476D1CE4E5B9u;
    return float(x >> 40) * 0x1.0p-24f;
}

/// [0, 1) Rank of a ball in the list of a tile of the screen.
/// @param instance, id identity of the ball in the scene: ids are unique in an instance
/// @param piece number of the ball in its streak
inline float listRank(uint64_t instance, uint64_t id, int piece)
{
    return float(base::hashWord(base::hashWord(instance, id), uint64_t(piece)) >> 40) * 0x1.0p-24f;
}

} // namespace fx::render
