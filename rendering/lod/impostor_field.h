/// @file impostor_field.h
/// Selects the effects of a view that are drawn as impostors, allocates tiles of their texture, and
/// schedules their re-rendering. Makes no GL calls.
///
/// Each effect has two impostors in tiles of one texture. The older impostor cross-fades to the newer
/// impostor, so that the picture changes smoothly. The shown state is at most 2 kInterval old. Threads: one
/// thread at a time. A frame allocates nothing if an earlier frame was at least as large.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/passes/impostor_pass.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// An effect that may be drawn as an impostor.
struct ImpostorSubject
{
    uint64_t instance;
    glm::vec3 center; ///< [m] center of the bounding ball, relative to the eye
    float radius;     ///< [m] radius of the bounding ball
    float pixels;     ///< [pixel] radius of the ball on the picture
};

/// How an effect is drawn in this frame.
struct ImpostorPlan
{
    /// [1] fraction of the effect's cross section that is drawn as blobs; 0: blobs need not be gathered
    float blobShare = 1.0f;
    bool isTaken = false; ///< true: the impostor is rendered from blobs in this frame
    uint32_t slot = 0;    ///< index of the impostor among the impostors rendered in this frame
};

class ImpostorField
{
public:
    /// [s] Interval at which the impostor of a changing effect is rendered again.
    static constexpr float kInterval = 0.1f;
    /// [1] Factor of Frame::mostPixels. Effects with a radius between kBand mostPixels and mostPixels are
    /// drawn both as impostor and as blobs, cross-faded.
    static constexpr float kBand = 0.75f;
    /// [pixel] Change of an impostor by rotation of the view, above which the impostor is rendered again.
    static constexpr float kParallax = 1.0f;
    static constexpr float kGrowth = 1.25f; ///< [1] factor of size above which an impostor is rendered again
    /// [s] Duration of the cross-fade from the blobs to the first impostor.
    static constexpr float kFadeSeconds = 0.25f;

    explicit ImpostorField(std::pmr::memory_resource* memory);

    struct Frame
    {
        float mostPixels; ///< [pixel] largest radius of an effect that is drawn as an impostor; 0: none
        double seconds;   ///< [s] since the last frame
        uint64_t content; ///< revision of the shown content
        /// Hash of the lighting. Impostors with a different hash are not shown.
        uint64_t lighting;
        bool forget;       ///< true: the camera has jumped
        bool hold = false; ///< true: impostors and their cross-fades do not change
    };
    void begin(const Frame& frame, const CameraGeometry& camera);
    /// Decides how an effect is drawn. Must be called once for each effect in a frame.
    ImpostorPlan plan(const ImpostorSubject& subject);
    void end(); ///< frees the tiles of effects without a call of plan() in this frame

    /// Camera axes and square size of the impostor that is rendered in `slot`.
    const ImpostorTaking& taking(uint32_t slot) const { return takings_[slot]; }
    std::span<const ImpostorTaking> takings() const { return takings_; }
    std::span<const ImpostorInstance> shown() const { return shown_; }
    std::span<const float> distances() const { return distances_; } ///< [m] distances of shown()
    /// True if no cross-fade is in progress and no impostor must be rendered again.
    bool isSettled() const { return settled_; }

private:
    struct Entry
    {
        uint64_t instance = 0;
        uint32_t tiles = 0;  ///< index of the first of the two tiles
        uint32_t newest = 0; ///< index of the tile with the newer impostor: 0 or 1
        float mix = 1.0f;    ///< [1] weight of the newer impostor; the older impostor has the weight 1 - mix
        float presence = 0.0f;  ///< [1] fraction of the effect that is drawn as an impostor
        glm::vec3 direction{0}; ///< view direction of the newer impostor
        glm::vec3 right{0}, up{0};
        float pixels = 0.0f;      ///< [pixel] radius on the picture when the newer impostor was rendered
        float olderPixels = 0.0f; ///< [pixel] radius on the picture when the older impostor was rendered
        uint64_t content = 0;
        uint64_t lighting = 0;
        bool hasPicture = false;
        bool hasOlder = false; ///< true: there are two impostors
        bool isUsed = false;
    };
    Entry* find(uint64_t instance);
    bool isStale(const Entry& entry, const ImpostorSubject& subject, const glm::vec3& direction) const;
    uint32_t take(Entry& entry, const ImpostorSubject& subject, const glm::vec3& direction);
    void show(const Entry& entry, const ImpostorSubject& subject, float opacity);

    Frame frame_{};
    const CameraGeometry* camera_ = nullptr;
    std::pmr::vector<Entry> entries_; ///< sorted by instance
    std::pmr::vector<Entry> fresh_;   ///< entries that were added in this frame
    std::pmr::vector<uint32_t> freeTiles_;
    std::pmr::vector<ImpostorTaking> takings_;
    std::pmr::vector<ImpostorInstance> shown_;
    std::pmr::vector<float> distances_;
    bool settled_ = true;
};

} // namespace fx::render
