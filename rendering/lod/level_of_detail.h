/// @file level_of_detail.h
/// Share of the particles of each effect that a view draws, by the size of the effect on the picture.
///
/// Particles are omitted in an order that is fixed for their lifetime, so that they do not flicker; the
/// remaining ones take over the light of the others. All changes are continuous: a particle at the threshold
/// is faded. The simulation does not depend on it. Threads: one thread at a time. Frames that are no larger
/// than one before allocate nothing.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/frame/view_block.h"
#include "rendering/frame/view_types.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace fx::render {

/// [0, 1) rank of a particle; particles with the highest ranks are omitted first. A golden-ratio sequence
/// with a random offset for each 1024 ids. Of any run of births, also of every second or third birth, about
/// the share s has ranks below s, with errors far below those of random numbers, and without long regular
/// patterns.
inline float birthRank(uint64_t id)
{
    const uint64_t block = id >> 10;
    const uint64_t x = (block ^ (block >> 31)) * 0x94D049BB133111EBu;
    const auto begin = uint32_t((x ^ (x >> 29)) * 0xBF58476D1CE4E5B9u >> 32);
    return float((begin + uint32_t(id & 1023u) * 0x9E3779B9u) >> 8) * 0x1.0p-24f;
}

/// @formula lod-weight
/// The share of a particle that is drawn when a group is thinned out, by its rank.
///
/// symbol  unit  meaning
///   r     1     rank, [0, 1), uniform over the particles of a group
///   s     1     share that is to be kept, > 0
///   f     1     half the width of the border over s, kFade
///   w     1     share of the particle that is drawn
///   m     1     mean of w over all ranks
///   c, c' m2    cross section before and after
///
/// @derivation
///   Ranks below a = s (1 - f) are kept, those above b = s (1 + f) are not, between both
///       w = (b - r) / (b - a)                                                                (1)
///   clamped to [0, 1]. Its mean over [0, 1) is the integral
///       m = a + (b - a) / 2 - max(b - 1, 0)^2 / (2 (b - a))   for a < 1, otherwise 1         (2)
///   so with
///       c' = c w / m                                                                         (3)
///   the expected sum of c' is the sum of c: optical depth is kept on average. For particles strewn at random
///   the variance of the optical depth of a ray is sum of c^2 / (A pi R^2) over an area A, so it stays the
///   same as well when the kept ones are drawn with the radius
///       R' = R / sqrt(m)                                                                     (4)
///
/// @source    textbook: the mean of a clamped ramp; first two moments of a Poisson process
/// @deviation (4) is limited to kGrown sqrt(bias) pixels, beyond which it would be seen as blur, and to R
/// plus
///            kSwollen of the radius of the group, beyond which the outline of thick effects would swell
/// @valid     s > 0; s >= kAll gives w = m = 1 exactly
/// @accuracy  |m - mean of w| <= 2^-22
/// @tests     tests/rendering/view/test_level_of_detail.cpp
class LodRamp
{
public:
    static constexpr float kFade = 0.25f;
    static constexpr float kAll = 1.0f / (1.0f - kFade); ///< share from which on all is drawn

    LodRamp() = default; ///< draws all
    explicit LodRamp(float share);
    float weight(float rank) const; ///< (1)
    float mean() const { return mean_; }
    bool isAll() const { return mean_ == 1.0f; }

private:
    float begin_ = 1.0f, end_ = 2.0f;
    float mean_ = 1.0f;
};

/// How one group is drawn.
struct LodLevel
{
    LodRamp ramp;
    float grownPixels = 0.0f;   ///< [pixel] largest radius to which a kept blob grows
    float swollenPixels = 0.0f; ///< [pixel] by which it grows at most
};

/// Groups by the share that is drawn of them: all; at least half; at least an eighth; less.
using LodCounts = std::array<uint32_t, 4>;

class LevelOfDetail
{
public:
    static constexpr float kBand = 1.15f;         ///< a level follows only beyond this factor
    static constexpr float kMinKeptBlobs = 12.0f; ///< blobs of a group, however small it is
    static constexpr float kGrown = 1.15f;        ///< [pixel] times sqrt(bias)
    static constexpr float kSwollen = 0.1f;       ///< of the radius of the group on the picture

    explicit LevelOfDetail(std::pmr::memory_resource* memory) : last_(memory), now_(memory) {}

    /// Begins a frame. @param forget ignore the levels of the last frame: the camera has jumped
    void begin(const LodSettings& settings, const CameraGeometry& camera, int height, bool forget);

    /// The level of a group. Called once a frame. Without a bias all elements are drawn.
    /// @param place of the group relative to the eye
    LodLevel levelOf(const base::GroupInfo& group, const base::Placement& place);

    /// The same for rows of particles and ribbons, which the counts leave out.
    /// @param pieces  that are drawn without a level of detail, particles or pieces of strips
    /// @param wholes  particles or strips that they make up, of which kMinKeptBlobs stay
    LodLevel levelOfRows(const base::GroupInfo& group, const base::Placement& place, uint32_t pieces,
                         uint32_t wholes);

    bool isOn() const { return settings_.bias > 0.0f; }
    const LodCounts& counts() const { return counts_; } ///< counts of this frame so far

private:
    struct Entry
    {
        uint64_t instance;
        uint32_t solver;
        uint32_t kind;
        float share;  ///< present share, within the hysteresis around the wanted one
        float radius; ///< [pixel] on the picture
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
