/// @file medium_volume.h
/// A medium on sparse voxels with the light that it emits, at one resolution.
///
/// Extinction, emitted light and scattering coefficient are interpolated linearly along each axis between the
/// centers of voxels. Places are given in voxels: the center of voxel (i, j, k) is at (i, j, k).
#pragma once

#include "foundation/assets/volume_lattice.h"
#include "foundation/assets/volume_levels.h"
#include "foundation/assets/voxel_volume.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace fx::render {

/// Threads: any thread may call const functions.
class MediumVolume
{
public:
    /// The medium at a place.
    struct Sample
    {
        double extinction = 0.0;   ///< [1/m]
        glm::dvec3 emitted{0.0};   ///< [cd/m3]
        glm::dvec3 scattered{0.0}; ///< [1/m] extinction times albedo
        double rate = 0.0;         ///< [1/s] of `emitted`, by formula volume-advection; 0 also: not known
    };

    /// Emitted light is that of a gray body at the temperature of the voxel, and the emission of the voxel:
    /// extinction (1 - albedo) B(T) + emission.
    explicit MediumVolume(const base::VoxelVolume& volume);

    bool hasVelocities() const { return !velocity_.empty(); }

    /// The same medium with voxels of twice the side. Each value is the mean of 3 x 3 x 3 values with weights
    /// 1/4, 1/2, 1/4 along each axis, so that integrals over space keep their values. Light of voxels that
    /// are optically thick is that of the side that is seen instead: formula escape-depth (4). Voxel (i, j,
    /// k) of the result has the center of voxel (2i, 2j, 2k).
    MediumVolume halved() const;

    Sample at(const glm::dvec3& place) const;
    /// The voxels around a place.
    struct Corners
    {
        std::array<double, 8> weight{};     ///< [1] of the interpolation
        std::array<double, 8> extinction{}; ///< [1/m]
    };
    Corners cornersAt(const glm::dvec3& place) const;
    /// [1/m] Largest extinction in the cells of a brick, see base::VolumeCells.
    float largestIn(const glm::ivec3& brick) const;
    float largest() const { return largest_; } ///< [1/m] largest extinction
    uint64_t hash() const { return hash_; }    ///< of the content
    const base::BrickIndex& index() const { return index_; }
    size_t bricks() const { return bricks_.size(); }

    /// A voxel in the layout of shaders/field/field_volume.comp.glsl: bits of the extinction [1/m]; emitted
    /// light over brightest() as half floats, red and green, then blue and the rate of emission [1/s]; albedo
    /// with 10 bits a component.
    using Packed = base::VolumeLevel::Packed;
    /// The voxels of all bricks in the order of the bricks, x fastest.
    std::vector<Packed> packed() const;
    /// As packed(), with the velocities of all voxels behind it, two voxels an element: half floats of x and
    /// y [voxel/s], then of z and of the divergence [1/s].
    std::vector<Packed> packedWithVelocities() const;
    float brightest() const { return brightest_; } ///< [cd/m3] largest component of emitted light, or 1

    /// A moment between two volumes.
    struct Moment
    {
        double part = 0.0;    ///< [1] 0: the first volume, 1: the second
        double seconds = 0.0; ///< [s] between the volumes; 0: the medium does not move, so that it is faded
        base::LatticeMap toFirst{}, toSecond{}; ///< from the voxels of the moment to those of the volumes
    };
    /// The medium at a moment between `first` and `second`, by formula volume-advection. At the centers of
    /// voxels it has the values of the GPU.
    static MediumVolume between(const MediumVolume& first, const MediumVolume& second, const Moment& moment);

private:
    /// Velocity [voxel/s] at a place and its weight [1/m], see formula volume-advection.
    struct Flow
    {
        double weight = 0.0;
        glm::dvec3 momentum{0.0}; ///< weight times velocity
        double growth = 0.0;      ///< weight times divergence [1/s]
    };
    Flow flowAt(const glm::dvec3& place) const;
    Flow flowAt(const glm::dvec3& place, const base::LatticeMap& toOwn) const; ///< both in voxels of the map
    /// Extinction and light are shifted by formula volume-advection (9).
    Sample shiftedAt(const glm::dvec3& place) const;
    std::vector<float> sharesOfLight() const;
    template <class Add>
    void addCorners(const glm::dvec3& place, const Add& add) const;
    MediumVolume(std::vector<glm::ivec3> bricks, float side, uint64_t hash);
    size_t voxelAt(const glm::ivec3& voxel) const; ///< index in the arrays, or kNone
    void findLargest();
    void findDivergence();

    static constexpr size_t kNone = ~size_t(0);
    std::vector<glm::ivec3> bricks_;
    base::BrickIndex index_;
    float side_ = 1.0f; ///< [m] of a voxel
    std::vector<float> extinction_;
    std::vector<glm::vec3> emitted_;   ///< empty: no light
    std::vector<float> rate_;          ///< [1/s] of emitted light; empty: not known
    std::vector<glm::vec3> scattered_; ///< [1/m] extinction times albedo
    std::vector<glm::vec3> velocity_;  ///< [voxel/s] empty: the medium does not move
    std::vector<float> divergence_;    ///< [1/s] of the velocity
    float largest_ = 0.0f, brightest_ = 1.0f;
    uint64_t hash_ = 0;
};

} // namespace fx::render
