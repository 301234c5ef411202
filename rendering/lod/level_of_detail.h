/// @file level_of_detail.h
/// Computes the fraction of the particles of each effect that a view draws, from the size of the effect on
/// the picture.
///
/// The order in which particles are omitted does not change during their lifetime, so that particles do not
/// flicker. The remaining particles are enlarged or made more opaque to represent the omitted particles. All
/// changes are continuous: a particle at the threshold is faded. The simulation does not depend on the level
/// of detail. Threads: one thread at a time. A frame allocates nothing if an earlier frame was at least as
/// large.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/frame/view_block.h"
#include "rendering/frame/view_types.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace fx::render {

/// Rank of a particle, [0, 1); particles with the highest ranks are omitted first. Ranks are a golden-ratio
/// sequence with a random offset for each 1024 ids. For any number s in [0, 1], about a fraction s of any
/// consecutive births has ranks below s. The property also holds for every second or every third birth. The
/// deviation from the fraction s is far less than for random numbers, and there are no long regular
/// patterns.
inline float birthRank(uint64_t id)
{
    const uint64_t block = id >> 10;
    const uint64_t x = (block ^ (block >> 31)) * 0x94D049BB133111EBu;
    const auto begin = uint32_t((x ^ (x >> 29)) * 0xBF58476D1CE4E5B9u >> 32);
    return float((begin + uint32_t(id & 1023u) * 0x9E3779B9u) >> 8) * 0x1.0p-24f;
}

/// @formula lod-weight
/// The weight of a particle, by its rank, when only a share of its group is drawn.
///
/// symbol  unit  meaning
///   r     1     rank, [0, 1), uniform over the particles of a group
///   s     1     share of the group to keep, > 0
///   f     1     half the width of the transition over s, kFade
///   w     1     weight of the particle: 0 omitted, 1 kept
///   m     1     mean of w over all ranks
///   c, c' m2    cross section before and after
///
/// @derivation
///   Ranks below a = s (1 - f) have w = 1, those above b = s (1 + f) have w = 0, and between both
///       w = (b - r) / (b - a)                                                                (1)
///   clamped to [0, 1]. Its mean over [0, 1) is the integral
///       m = a + (b - a) / 2 - max(b - 1, 0)^2 / (2 (b - a))   for a < 1, otherwise 1         (2)
///   so with
///       c' = c w / m                                                                         (3)
///   the expected sum of c' is the sum of c: optical depth is kept on average. For random positions, the
///   variance of the optical depth of a ray is the sum of c^2 / (A pi R^2) over an area A. So the variance is
///   kept too, if particles are drawn with the radius
///       R' = R / sqrt(m)                                                                     (4)
///
/// @source    textbook: the mean of a clamped ramp; first two moments of a Poisson process
/// @deviation R' is limited to kGrown sqrt(bias) pixels, because larger radii would be visible as blur, and
///            to R plus kSwollen times the radius of the group, because thick effects would become larger
/// @valid     s > 0; s >= kAll gives w = m = 1 exactly
/// @accuracy  |m - mean of w| <= 2^-22
/// @tests     tests/rendering/view/test_level_of_detail.cpp
class LodRamp
{
public:
    static constexpr float kFade = 0.25f;
    /// Least value of s with which all particles are drawn.
    static constexpr float kAll = 1.0f / (1.0f - kFade);

    LodRamp() = default; ///< draws all particles
    explicit LodRamp(float share);
    float weight(float rank) const; ///< equation (1)
    float mean() const { return mean_; }
    bool isAll() const { return mean_ == 1.0f; }

private:
    float begin_ = 1.0f, end_ = 2.0f;
    float mean_ = 1.0f;
};

/// Parameters with which the elements of a group are drawn.
struct LodLevel
{
    LodRamp ramp;
    float grownPixels = 0.0f;   ///< [pixel] largest radius to which a blob is enlarged
    float swollenPixels = 0.0f; ///< [pixel] largest increase of the radius of a blob
};

/// Number of groups with a drawn fraction of 1; at least 1/2; at least 1/8; less than 1/8.
using LodCounts = std::array<uint32_t, 4>;

class LevelOfDetail
{
public:
    /// Hysteresis: a level changes only if the size changes by more than this factor.
    static constexpr float kBand = 1.15f;
    static constexpr float kMinKeptBlobs = 12.0f; ///< least number of drawn blobs of a group
    static constexpr float kGrown = 1.15f;        ///< [pixel] see formula lod-weight
    static constexpr float kSwollen = 0.1f;       ///< [1] see formula lod-weight

    explicit LevelOfDetail(std::pmr::memory_resource* memory) : last_(memory), now_(memory) {}

    /// Begins a frame. @param forget true: the camera has jumped, and levels of the last frame are ignored
    void begin(const LodSettings& settings, const CameraGeometry& camera, int height, bool forget);

    /// Returns the level of a group. Must be called once per frame for each group. If LodSettings::bias is
    /// 0, all elements are drawn.
    /// @param place placement of the group relative to the eye
    LodLevel levelOf(const base::GroupInfo& group, const base::Placement& place);

    /// Returns the level of a group of particles or ribbons. counts() does not count the group.
    /// @param pieces  number of drawn particles, or of drawn pieces of strips, without level of detail
    /// @param wholes  number of particles, or of strips; at least kMinKeptBlobs particles or strips are drawn
    LodLevel levelOfRows(const base::GroupInfo& group, const base::Placement& place, uint32_t pieces,
                         uint32_t wholes);

    bool isOn() const { return settings_.bias > 0.0f; }
    /// Counts of the groups of this frame so far.
    const LodCounts& counts() const { return counts_; }

private:
    struct Entry
    {
        uint64_t instance;
        uint32_t solver;
        uint32_t kind;
        /// Drawn fraction. With hysteresis, it may differ from the fraction for the present size.
        float share;
        float radius; ///< [pixel] radius of the group on the picture
        bool operator<(const Entry& other) const;
    };
    float radiusOnPicture(const base::GroupInfo& group, const base::Placement& place) const;
    LodLevel find(const base::GroupInfo& group, const base::Placement& place, uint32_t pieces,
                  uint32_t wholes);
    const Entry* lastOf(const base::GroupInfo& group) const;

    LodSettings settings_;
    const CameraGeometry* camera_ = nullptr;
    float pixelsPerSlope_ = 1.0f;
    std::pmr::vector<Entry> last_; ///< sorted
    std::pmr::vector<Entry> now_;
    LodCounts counts_{};
};

} // namespace fx::render
