#include "rendering/view/snapshot_match.h"

#include <glm/gtc/quaternion.hpp>

namespace fx::render {

size_t findSameGroup(const base::FrameSnapshot* older, const base::GroupInfo& info, size_t hint)
{
    if (!older)
        return kNoGroup;
    const auto same = [&](size_t g) {
        const base::GroupInfo& other = older->group(g).info();
        return other.instance == info.instance && other.solver == info.solver && other.kind == info.kind;
    };
    if (hint < older->groupCount() && same(hint))
        return hint;
    for (size_t g = 0; g < older->groupCount(); ++g)
        if (same(g))
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

} // namespace fx::render
