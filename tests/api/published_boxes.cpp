#include "tests/api/published_boxes.h"

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/particle_kind.h"
#include "foundation/time/ticks.h"

#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::test {

namespace {

namespace constant = base::particle_constant;

constexpr double kNowhere = std::numeric_limits<double>::infinity();
constexpr int kMoments = 4; ///< between two steps

void add(PublishedBox& io, const glm::dvec3& center, double reach)
{
    io.low = glm::min(io.low, center - reach);
    io.high = glm::max(io.high, center + reach);
}

PublishedBox::Place placeOf(const FxSnapshotGroup& group)
{
    const float* q = group.rotation;
    return {glm::make_vec3(group.position), glm::dquat(q[3], q[0], q[1], q[2]), double(group.scale)};
}

bool isSame(const PublishedBox::Place& a, const PublishedBox::Place& b)
{
    return a.position == b.position && a.rotation == b.rotation && a.scale == b.scale;
}

PublishedBox::Place between(const PublishedBox::Place& a, const PublishedBox::Place& b, double share)
{
    const glm::dquat to = glm::dot(a.rotation, b.rotation) < 0.0 ? -b.rotation : b.rotation;
    return {glm::mix(a.position, b.position, share), glm::normalize(a.rotation * (1.0 - share) + to * share),
            glm::mix(a.scale, b.scale, share)};
}

bool isOfKind(const FxSnapshotGroup& group, const char* kind)
{
    return std::string_view(group.kind) == kind;
}

} // namespace

const char* nameOf(Without what)
{
    constexpr const char* kNames[] = {"nothing", "rows",        "a tenth", "size",   "stretch",
                                      "shutter", "late births", "chains",  "trails", "a placement"};
    static_assert(std::size(kNames) == size_t(Without::Count));
    return kNames[size_t(what)];
}

std::vector<glm::dvec3> cornersOf(const std::vector<PublishedBox>& boxes)
{
    std::vector<glm::dvec3> corners;
    for (const PublishedBox& box : boxes)
        for (int moment = 0; moment <= (isSame(box.place, box.other) ? 0 : kMoments); ++moment) {
            const PublishedBox::Place at = between(box.place, box.other, double(moment) / kMoments);
            for (int i = 0; i < 8; ++i) {
                const glm::dvec3 corner(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                                        i & 4 ? box.high.z : box.low.z);
                corners.push_back(at.position + at.rotation * (corner * at.scale));
            }
        }
    return corners;
}

PublishedBoxes::PublishedBoxes(FxScene* scene) : scene_(scene)
{
    FxSnapshotInfo info{};
    info.structSize = sizeof info;
    EXPECT_EQ(fxScene_AcquireSnapshot(scene, &id_), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(fxScene_GetSnapshotInfo(scene, id_, &info), FX_OK);
    secondsBack_ = info.groupsOlder > 0 ? base::toSeconds(info.tickNewer - info.tickOlder) : 0.0;
    for (const FxSnapshotStep step : {FX_SNAPSHOT_NEWER, FX_SNAPSHOT_OLDER})
        for (uint32_t i = 0; i < (step == FX_SNAPSHOT_NEWER ? info.groupsNewer : info.groupsOlder); ++i) {
            Group group{{}, step, i};
            group.info.structSize = sizeof group.info;
            EXPECT_EQ(fxScene_GetSnapshotGroup(scene, id_, step, i, &group.info), FX_OK);
            if (!isOfKind(group.info, "light")) // what they light has its own bounds
                groups_.push_back(group);
        }
}

PublishedBoxes::~PublishedBoxes()
{
    EXPECT_EQ(fxScene_ReleaseSnapshot(scene_, id_), FX_OK);
}

const float* PublishedBoxes::column(const Group& group, const char* name) const
{
    FxSnapshotColumn column{};
    column.structSize = sizeof column;
    EXPECT_EQ(fxScene_FindSnapshotColumn(scene_, id_, group.step, group.index, name, &column), FX_OK)
        << fxGetLastErrorMessage();
    return column.values;
}

const PublishedBoxes::Group* PublishedBoxes::sameInOtherStep(const Group& group) const
{
    for (const Group& other : groups_)
        if (other.step != group.step && other.info.solver == group.info.solver &&
            isOfKind(other.info, group.info.kind))
            return &other;
    return nullptr;
}

bool PublishedBoxes::isLeftOut(const Group& group, Without what) const
{
    return (what == Without::Children && group.info.solver > 0) ||
           (what == Without::Trails && isOfKind(group.info, "ribbon"));
}

/// Media: balls, drawn out along their way while the shutter is open, and on it when they were born late.
void PublishedBoxes::addBlobs(const Group& group, Without what, PublishedBox& io) const
{
    const float *x = column(group, "x"), *y = column(group, "y"), *z = column(group, "z");
    const float *vx = column(group, "vx"), *vy = column(group, "vy"), *vz = column(group, "vz");
    const float *radius = column(group, "radius"), *age = column(group, "age");
    const double shutter = group.info.constants[base::blob_constant::Shutter];
    for (uint32_t i = 0; i < group.info.count; ++i) {
        const glm::dvec3 center(x[i], y[i], z[i]), velocity(vx[i], vy[i], vz[i]);
        const double size = what == Without::Size ? 0.0 : double(radius[i]);
        add(io, center, size);
        double back = what == Without::Shutter ? 0.0 : shutter;
        if (what != Without::Births)
            back += std::min(double(age[i]), secondsBack_);
        if (back > 0.0)
            add(io, center - back * velocity, size);
    }
}

void PublishedBoxes::addSprites(const Group& group, Without what, PublishedBox& io) const
{
    const float *x = column(group, "x"), *y = column(group, "y"), *z = column(group, "z");
    const float *vx = column(group, "vx"), *vy = column(group, "vy"), *vz = column(group, "vz");
    const float *radius = column(group, "radius"), *age = column(group, "age");
    const float* angle = column(group, "angle");
    const float* constants = group.info.constants;
    const double aspect = double(constants[constant::Aspect]);
    const double stretch = what == Without::Stretch ? 0.0 : 0.5 * double(constants[constant::Stretch]);
    for (uint32_t i = 0; i < group.info.count; ++i) {
        if (!(radius[i] > 0.0f))
            continue;
        const glm::dvec3 center(x[i], y[i], z[i]);
        const glm::dvec3 velocity = vx ? glm::dvec3(vx[i], vy[i], vz[i]) : glm::dvec3(0.0);
        const double wide = aspect * double(radius[i]);
        const double high = double(radius[i]) + (angle ? stretch * glm::length(velocity) : 0.0);
        const double reach = what == Without::Size ? 0.0 : std::sqrt(wide * wide + high * high);
        const glm::dvec3 along = angle ? glm::dvec3(0.0) : stretch * velocity;
        const double back = what == Without::Births ? 0.0 : std::min(double(age[i]), secondsBack_);
        add(io, center + along, reach);
        add(io, center - back * velocity - along, reach);
    }
}

void PublishedBoxes::addRows(const Group& group, Without what, PublishedBox& io) const
{
    if (isOfKind(group.info, "blob"))
        return addBlobs(group, what, io);
    const bool isRibbon = isOfKind(group.info, "ribbon");
    if (!isRibbon && group.info.constants[constant::Shape] == float(uint32_t(base::ParticleShape::Sprite)))
        return addSprites(group, what, io);
    const float *x = column(group, "x"), *y = column(group, "y"), *z = column(group, "z");
    const float* size = column(group, isRibbon ? "halfWidth" : "radius");
    for (uint32_t i = 0; i < group.info.count; ++i)
        if (isRibbon || size[i] > 0.0f)
            add(io, {x[i], y[i], z[i]}, what == Without::Size ? 0.0 : double(size[i]));
}

std::vector<PublishedBox> PublishedBoxes::boxes(Without what) const
{
    std::vector<PublishedBox> boxes;
    for (const Group& group : groups_) {
        if (isLeftOut(group, what) || !(group.info.boundsMin[0] <= group.info.boundsMax[0]))
            continue;
        PublishedBox box{glm::dvec3(kNowhere), glm::dvec3(-kNowhere), placeOf(group.info), {}};
        const Group* other = sameInOtherStep(group);
        box.other = other ? placeOf(other->info) : box.place;
        if (what == Without::OlderPlace && group.step == FX_SNAPSHOT_OLDER)
            box.place = box.other;
        else if (what == Without::OlderPlace)
            box.other = box.place;
        // The distance of a mesh's corners from its middle is not published.
        const bool isMesh =
            isOfKind(group.info, "particle") &&
            group.info.constants[constant::Shape] == float(uint32_t(base::ParticleShape::Mesh));
        const bool byRows = what == Without::Size || (!isMesh && what == Without::Rows) ||
                            (!isMesh && what >= Without::Stretch && what <= Without::Births);
        if (byRows) {
            addRows(group, what, box);
        } else {
            box.low = glm::make_vec3(group.info.boundsMin);
            box.high = glm::make_vec3(group.info.boundsMax);
        }
        if (what == Without::Tenth) {
            const glm::dvec3 less = 0.05 * (box.high - box.low);
            box.low += less;
            box.high -= less;
        }
        if (box.low.x <= box.high.x)
            boxes.push_back(box);
    }
    return boxes;
}

} // namespace fx::test
