/// @file published_boxes.h
/// Where snapshots say that something is: the bounds of their groups, and boxes that a writer would have
/// given who has forgotten something.
#pragma once

#include "fxsdk/fx_snapshot.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace fx::test {

/// What is left out of the bounds.
enum class Without
{
    Nothing,  ///< the bounds as they are published
    Rows,     ///< nothing, but found anew, row by row: no larger than what is published
    Tenth,    ///< of their size
    Size,     ///< radii, corners and widths
    Stretch,  ///< by which sprites are longer for their speed
    Shutter,  ///< for which media are drawn out
    Births,   ///< on the way from where they happened since the older snapshot
    Children, ///< emitters that others cause births in
    Trails,
    OlderPlace, ///< where the instance was before its last move
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

/// Corners in the world of all boxes; of boxes that move, at moments between both steps as well.
std::vector<glm::dvec3> cornersOf(const std::vector<PublishedBox>& boxes);

/// One snapshot of a scene, held while it lives.
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
