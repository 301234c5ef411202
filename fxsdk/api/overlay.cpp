#include "fxsdk/api/overlay.h"

#include <algorithm>
#include <cmath>

namespace fx::api {

namespace {

constexpr double kUnknownReach = 0.5; ///< [m] half the side of a box of unknown extent
constexpr double kLargest = 1e6;      ///< [m]
constexpr float kOpacity = 0.8f;

glm::vec3 colorOf(const scene::Mark& mark)
{
    switch (mark.state) {
    case scene::InstanceState::Active:
        return {0.1f, 1.0f, 0.2f};
    case scene::InstanceState::Waking:
        return {1.0f, 0.9f, 0.1f};
    case scene::InstanceState::Resting:
        return {0.2f, 0.5f, 1.0f};
    case scene::InstanceState::Hidden:
        if (mark.reason == scene::Reason::Budget)
            return {1.0f, 0.2f, 1.0f};
        return mark.reason == scene::Reason::Occluded ? glm::vec3(1.0f, 0.5f, 0.1f)
                                                      : glm::vec3(1.0f, 0.1f, 0.1f);
    default:
        return {0.7f, 0.7f, 0.7f};
    }
}

} // namespace

void makeOverlay(std::span<const scene::Mark> marks, const glm::dvec3& origin,
                 std::pmr::vector<render::OverlayBox>& out)
{
    out.clear();
    for (const scene::Mark& mark : marks) {
        const double half = std::isfinite(mark.reach) ? std::min(mark.reach, kLargest) : kUnknownReach;
        out.push_back({glm::vec4(glm::vec3(mark.position - origin), float(half)),
                       glm::vec4(kOpacity * colorOf(mark), kOpacity)});
    }
}

} // namespace fx::api
