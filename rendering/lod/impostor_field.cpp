#include "rendering/lod/impostor_field.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::render {

namespace {

constexpr float kMarginPixels = 3.0f; ///< around the ball: blobs are widened to pixels
constexpr float kFarEnough = 8.0f;    ///< [1] distance over radius: nearer, perspective would show

/// [1] side of the picture of a ball that has a radius of so many pixels, over the ball's diameter.
float sideOf(float pixels)
{
    return 1.0f + kMarginPixels / pixels;
}

} // namespace

ImpostorField::ImpostorField(std::pmr::memory_resource* memory)
    : entries_(memory), fresh_(memory), freeTiles_(memory), takings_(memory), shown_(memory),
      distances_(memory)
{}

void ImpostorField::begin(const Frame& frame, const CameraGeometry& camera)
{
    frame_ = frame;
    camera_ = &camera;
    takings_.clear();
    shown_.clear();
    distances_.clear();
    settled_ = true;
    if (frame.mostPixels > 0.0f && entries_.empty() && freeTiles_.empty()) // the first time
        for (uint32_t pair = kImpostorTiles / 2; pair-- > 0;)
            freeTiles_.push_back(2 * pair);
    for (Entry& entry : entries_) {
        entry.isUsed = false;
        entry.mix = std::min(entry.mix + (frame.hold ? 0.0f : float(frame.seconds) / kInterval), 1.0f);
        entry.hasPicture = entry.hasPicture && !frame.forget && entry.lighting == frame.lighting;
    }
}

ImpostorField::Entry* ImpostorField::find(uint64_t instance)
{
    const auto before = std::lower_bound(entries_.begin(), entries_.end(), instance,
                                         [](const Entry& e, uint64_t id) { return e.instance < id; });
    return before != entries_.end() && before->instance == instance ? &*before : nullptr;
}

bool ImpostorField::isStale(const Entry& entry, const ImpostorSubject& subject,
                            const glm::vec3& direction) const
{
    const float turned =
        glm::length(direction - entry.direction) * subject.pixels; // [pixel] at the ball's rim
    return entry.content != frame_.content || turned > kParallax || subject.pixels > kGrowth * entry.pixels ||
           subject.pixels * kGrowth < entry.pixels;
}

uint32_t ImpostorField::take(Entry& entry, const ImpostorSubject& subject, const glm::vec3& direction)
{
    const bool isFirst = !entry.hasPicture;
    entry.newest ^= 1u;
    entry.mix = isFirst ? 1.0f : 0.0f;
    entry.hasOlder = !isFirst;
    entry.hasPicture = true;
    entry.direction = direction;
    entry.right = glm::normalize(glm::cross(direction, camera_->up));
    entry.up = glm::cross(entry.right, direction);
    entry.olderPixels = isFirst ? subject.pixels : entry.pixels;
    entry.pixels = subject.pixels;
    entry.content = frame_.content;
    entry.lighting = frame_.lighting;
    takings_.push_back({subject.center, subject.radius * sideOf(subject.pixels), entry.right, entry.up,
                        direction, entry.tiles + entry.newest});
    return uint32_t(takings_.size() - 1);
}

ImpostorPlan ImpostorField::plan(const ImpostorSubject& subject)
{
    ImpostorPlan plan;
    const float distance = glm::length(subject.center);
    if ((!frame_.hold && !(subject.pixels < frame_.mostPixels)) || distance < kFarEnough * subject.radius ||
        camera_->orthographic)
        return plan;
    Entry* entry = find(subject.instance);
    if (!entry) {
        if (freeTiles_.empty() || frame_.hold)
            return plan;
        Entry made;
        made.instance = subject.instance;
        made.tiles = freeTiles_.back();
        freeTiles_.pop_back();
        fresh_.push_back(made);
        entry = &fresh_.back();
    }
    entry->isUsed = true;
    const glm::vec3 direction = subject.center / distance;
    const bool isDue =
        !frame_.hold && (!entry->hasPicture || (entry->mix >= 1.0f && isStale(*entry, subject, direction)));
    if (isDue && takings_.size() < kImpostorTakings) {
        plan.isTaken = true;
        plan.slot = take(*entry, subject, direction);
    }
    const float wanted = 1.0f - glm::smoothstep(kBand * frame_.mostPixels, frame_.mostPixels, subject.pixels);
    if (!entry->hasPicture)
        entry->presence = 0.0f;
    else if (!frame_.hold)
        entry->presence = std::min(wanted, entry->presence + float(frame_.seconds) / kFadeSeconds);
    if (entry->presence > 0.0f)
        show(*entry, subject, entry->presence);
    plan.blobShare = 1.0f - entry->presence;
    settled_ = settled_ && !isDue && entry->mix >= 1.0f && entry->presence == wanted;
    return plan;
}

void ImpostorField::show(const Entry& entry, const ImpostorSubject& subject, float opacity)
{
    const uint32_t older = entry.hasOlder ? entry.newest ^ 1u : entry.newest; // a tile that was written
    // the square grows with what is shown: the ball's radius may have changed since
    shown_.push_back(
        {{subject.center, subject.radius * sideOf(entry.pixels)},
         {entry.right, float(entry.tiles + entry.newest)},
         {entry.up, float(entry.tiles + older)},
         {entry.mix, opacity, subject.radius, sideOf(entry.pixels) / sideOf(entry.olderPixels)}});
    distances_.push_back(glm::length(subject.center));
}

void ImpostorField::end()
{
    std::erase_if(entries_, [&](const Entry& entry) {
        if (!entry.isUsed)
            freeTiles_.push_back(entry.tiles);
        return !entry.isUsed;
    });
    if (fresh_.empty())
        return;
    entries_.insert(entries_.end(), fresh_.begin(), fresh_.end());
    fresh_.clear();
    std::sort(entries_.begin(), entries_.end(),
              [](const Entry& a, const Entry& b) { return a.instance < b.instance; });
}

} // namespace fx::render
