/// @file published_boxes.h
/// The published bounds of the groups of snapshots, and deliberately incomplete bounds for comparison.
#pragma once

#include "fxsdk/fx_snapshot.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace fx::test {

/// Kinds of incomplete bounds, by what is omitted.
enum class Without
{
    Nothing, ///< nothing is omitted; the bounds are the published bounds
    /// Nothing is omitted, but bounds are computed again row by row. These bounds are never larger than the
    /// published bounds.
    Rows,
    Tenth,    ///< a tenth of the size of the bounds
    Size,     ///< radii, corners and widths
    Stretch,  ///< the stretching of sprites by their speed
    Shutter,  ///< the stretching of media by the open shutter
    Births,   ///< paths of particles born since the older snapshot
    Children, ///< emitters whose births are caused by other emitters
    Trails,
    OlderPlace, ///< the placement that the instance had before its last move
    Count
};
const char* nameOf(Without what);

/// A box that is aligned with the axes of the local space. The box has one or two placements.
struct PublishedBox
{
    glm::dvec3 low, high;
    struct Place
    {
        glm::dvec3 position;
        glm::dquat rotation;
        double scale;
    };
    Place place,
        other; ///< `place` is the placement at the step of the box, `other` the placement at the second step
};

/// Corners of all boxes in the world. For moving boxes, the corners at times between both steps are included.
std::vector<glm::dvec3> cornersOf(const std::vector<PublishedBox>& boxes);

/// The boxes of one snapshot of a scene. The snapshot is acquired during the lifetime of this object.
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
