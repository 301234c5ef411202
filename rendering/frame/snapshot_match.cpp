#include "rendering/frame/snapshot_match.h"

#include <glm/gtc/quaternion.hpp>

namespace fx::render {

size_t findSameGroup(const base::FrameSnapshot* older, const base::GroupName& name, size_t hint)
{
    if (!older)
        return kNoGroup;
    if (hint < older->groupCount() && older->name(hint) == name)
        return hint;
    for (size_t g = 0; g < older->groupCount(); ++g)
        if (older->name(g) == name)
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
