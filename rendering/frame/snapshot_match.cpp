#include "rendering/frame/snapshot_match.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>

namespace fx::render {

namespace {

/// Number of groups with the name of group `index` that its solver has published before it.
size_t ordinalOf(const base::FrameSnapshot& snapshot, size_t index)
{
    const base::GroupName name = snapshot.name(index);
    size_t ordinal = 0;
    for (size_t g = index; g > 0; --g) {
        const base::GroupName before = snapshot.name(g - 1);
        if (before.instance != name.instance || before.solver != name.solver)
            break;
        ordinal += before == name;
    }
    return ordinal;
}

} // namespace

size_t findSameGroup(const base::FrameSnapshot* older, const base::FrameSnapshot& newer, size_t index)
{
    if (!older)
        return kNoGroup;
    const base::GroupName name = newer.name(index);
    const size_t ordinal = ordinalOf(newer, index);
    if (index < older->groupCount() && older->name(index) == name && ordinalOf(*older, index) == ordinal)
        return index;
    size_t before = 0;
    for (size_t g = 0; g < older->groupCount(); ++g)
        if (older->name(g) == name && before++ == ordinal)
            return g;
    return kNoGroup;
}

base::Placement placementAt(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, float t,
                            const glm::dvec3& eye)
{
    base::Placement p = newer.info().placement;
    if (older) {
        const base::Placement& o = older->info().placement;
        p.position = o.position + (p.position - o.position) * double(t);
        p.rotation = glm::slerp(o.rotation, p.rotation, t);
        p.scale = o.scale + (p.scale - o.scale) * t;
    }
    p.position -= eye;
    return p;
}

const base::ShownPlacement* shownPlacement(const base::SnapshotPair& snapshots, uint64_t instance)
{
    const auto at = std::lower_bound(
        snapshots.shown.begin(), snapshots.shown.end(), instance,
        [](const base::ShownPlacement& one, uint64_t wanted) { return one.instance < wanted; });
    return at != snapshots.shown.end() && at->instance == instance ? &*at : nullptr;
}

base::Placement placementAt(const base::SnapshotPair& snapshots, const base::SnapshotGroup& newer,
                            const base::SnapshotGroup* older, float t, const glm::dvec3& eye)
{
    const bool follows = !snapshots.shown.empty() && !newer.info().staysInWorld;
    const base::ShownPlacement* const shown =
        follows ? shownPlacement(snapshots, newer.info().instance) : nullptr;
    if (!shown)
        return placementAt(newer, older, t, eye);
    base::Placement p = shown->placement;
    p.position -= eye;
    return p;
}

PlaceDrift placeDrift(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, float seconds)
{
    if (!older || !(seconds > 0.0f))
        return {};
    const base::Placement& now = newer.info().placement;
    const base::Placement& then = older->info().placement;
    const glm::mat3 turned =
        glm::mat3_cast(now.rotation) * now.scale - glm::mat3_cast(then.rotation) * then.scale;
    return {turned / seconds, glm::vec3((now.position - then.position) / double(seconds))};
}

} // namespace fx::render
