/// @file impostor_field.h
/// Selects the effects of a view that are drawn as impostors, allocates their textures, and schedules their
/// re-rendering. No GL.
///
/// Each effect has two impostors in tiles of one texture. The older one is cross-faded into the newer one, so
/// that the picture does not jump. The shown state is at most two intervals old. Threads: one thread at a
/// time. Frames that are no larger than one before allocate nothing.
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
    glm::vec3 center; ///< [m] of the ball around it, relative to the eye
    float radius;     ///< [m]
    float pixels;     ///< [pixel] of the ball's radius on the picture
};

/// How an effect is drawn in this frame.
struct ImpostorPlan
{
    float blobShare = 1.0f; ///< [1] of its cross section that is drawn as blobs; 0: none need be gathered
    bool isTaken = false;   ///< its blobs are to be drawn into a picture as well
    uint32_t slot = 0;      ///< index of the impostor among those rendered in this frame
};

class ImpostorField
{
public:
    /// [s] interval of re-rendering the impostor of a changing effect.
    static constexpr float kInterval = 0.1f;
    /// Share of the largest size above which both the impostor and the effect are drawn.
    static constexpr float kBand = 0.75f;
    static constexpr float kParallax = 1.0f;     ///< [pixel] by which the view may have turned
    static constexpr float kGrowth = 1.25f;      ///< factor by which the size may have changed
    static constexpr float kFadeSeconds = 0.25f; ///< [s] in which a first picture replaces its blobs

    explicit ImpostorField(std::pmr::memory_resource* memory);

    struct Frame
    {
        float mostPixels;  ///< [pixel] radius up to which effects are pictures; 0: none
        double seconds;    ///< [s] since the last frame
        uint64_t content;  ///< revision of the shown content
        uint64_t lighting; ///< hash of its lighting: impostors of another lighting are not shown
        bool forget;       ///< the camera has jumped
        bool hold = false; ///< impostors and their shares do not change
    };
    void begin(const Frame& frame, const CameraGeometry& camera);
    /// Called once for each effect in a frame.
    ImpostorPlan plan(const ImpostorSubject& subject);
    void end(); ///< frees the tiles of effects that were not planned in this frame

    /// Axes of the picture that is taken in `slot`, and the size of its square.
    const ImpostorTaking& taking(uint32_t slot) const { return takings_[slot]; }
    std::span<const ImpostorTaking> takings() const { return takings_; }
    std::span<const ImpostorInstance> shown() const { return shown_; }
    std::span<const float> distances() const { return distances_; } ///< [m] of shown()
    /// True when no cross-fade is in progress and no impostor is due.
    bool isSettled() const { return settled_; }

private:
    struct Entry
    {
        uint64_t instance = 0;
        uint32_t tiles = 0;     ///< first of two
        uint32_t newest = 0;    ///< 0, 1: of the two
        float mix = 1.0f;       ///< [1] of the newer over the older
        float presence = 0.0f;  ///< [1] share that is shown by pictures at all
        glm::vec3 direction{0}; ///< in which the newer was taken
        glm::vec3 right{0}, up{0};
        float pixels = 0.0f;      ///< [pixel] then
        float olderPixels = 0.0f; ///< [pixel] when the older was taken
        uint64_t content = 0;
        uint64_t lighting = 0;
        bool hasPicture = false;
        bool hasOlder = false; ///< two impostors exist
        bool isUsed = false;
    };
    Entry* find(uint64_t instance);
    bool isStale(const Entry& entry, const ImpostorSubject& subject, const glm::vec3& direction) const;
    uint32_t take(Entry& entry, const ImpostorSubject& subject, const glm::vec3& direction);
    void show(const Entry& entry, const ImpostorSubject& subject, float opacity);

    Frame frame_{};
    const CameraGeometry* camera_ = nullptr;
    std::pmr::vector<Entry> entries_; ///< sorted by instance
    std::pmr::vector<Entry> fresh_;   ///< of this frame
    std::pmr::vector<uint32_t> freeTiles_;
    std::pmr::vector<ImpostorTaking> takings_;
    std::pmr::vector<ImpostorInstance> shown_;
    std::pmr::vector<float> distances_;
    bool settled_ = true;
};

} // namespace fx::render
