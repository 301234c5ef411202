/// @file published_boxes.h
/// The published bounds of the groups of snapshots, and deliberately incomplete bounds for comparison.
#pragma once

#include "fxsdk/fx_snapshot.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace fx::test {

/// The part that is omitted from the bounds.
enum class Without
{
    Nothing,  ///< the bounds as they are published
    Rows,     ///< nothing; computed again row by row, never larger than the published bounds
    Tenth,    ///< a tenth of their size
    Size,     ///< radii, corners and widths
    Stretch,  ///< the stretching of sprites by their speed
    Shutter,  ///< the stretching of media by the open shutter
    Births,   ///< the path from births since the older snapshot
    Children, ///< emitters whose births other emitters cause
    Trails,
    OlderPlace, ///< the placement of the instance before its last move
    Count
};
const char* nameOf(Without what);

/// Axis-aligned in the local space of one or two placements.
struct PublishedBox
{
    glm::dvec3 low, high;
    struct Place
    {
        glm::dvec3 position;
        glm::dquat rotation;
        double scale;
    };
    Place place, other; ///< of its own step and of the other
};

/// Corners of all boxes in the world; for moving boxes also at times between both steps.
std::vector<glm::dvec3> cornersOf(const std::vector<PublishedBox>& boxes);

/// One snapshot of a scene, held during the lifetime of this object.
class PublishedBoxes
{
public:
    explicit PublishedBoxes(FxScene* scene);
    ~PublishedBoxes();
    PublishedBoxes(const PublishedBoxes&) = delete;
    PublishedBoxes& operator=(const PublishedBoxes&) = delete;

    std::vector<PublishedBox> boxes(Without what) const;

private:
    struct Group
    {
        FxSnapshotGroup info;
        FxSnapshotStep step;
        uint32_t index;
    };
    const float* column(const Group& group, const char* name) const;
    void addRows(const Group& group, Without what, PublishedBox& io) const;
    void addBlobs(const Group& group, Without what, PublishedBox& io) const;
    void addSprites(const Group& group, Without what, PublishedBox& io) const;
    bool isLeftOut(const Group& group, Without what) const;
    const Group* sameInOtherStep(const Group& group) const;

    FxScene* scene_;
    FxSnapshotId id_{};
    double secondsBack_ = 0; ///< [s] between both steps
    std::vector<Group> groups_;
};

} // namespace fx::test
