#include "rendering/vdb/vdb_points.h"

#include "rendering/voxelization/medium_grid.h"

#include <openvdb/openvdb.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace fx::render {

openvdb::GridBase::Ptr makePoints(std::span<const VoxelBall> balls, double voxelSize, bool areMedium)
{
    namespace points = openvdb::points;
    std::vector<openvdb::Vec3d> places;
    std::vector<openvdb::Vec3f> velocities;
    std::vector<openvdb::Vec3f> albedos;
    std::vector<float> radii, ages;
    std::vector<int64_t> ids, instances;
    for (const VoxelBall& ball : balls) {
        places.emplace_back(ball.center.x, ball.center.y, ball.center.z);
        velocities.emplace_back(float(ball.velocity.x), float(ball.velocity.y), float(ball.velocity.z));
        albedos.emplace_back(float(ball.albedo.x), float(ball.albedo.y), float(ball.albedo.z));
        radii.push_back(float(ball.radius));
        ages.push_back(float(ball.age));
        ids.push_back(int64_t(ball.id));
        instances.push_back(int64_t(ball.instance));
    }
    const auto transform = openvdb::math::Transform::createLinearTransform(voxelSize);
    const points::PointAttributeVector<openvdb::Vec3d> positions(places);
    const auto order =
        openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(positions, *transform);
    auto grid =
        points::createPointDataGrid<points::NullCodec, points::PointDataGrid>(*order, positions, *transform);
    const auto addAttribute = [&](const char* name, const auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        points::appendAttribute<Value>(grid->tree(), name);
        points::populateAttribute(grid->tree(), order->tree(), name,
                                  points::PointAttributeVector<Value>(values));
    };
    addAttribute("id", ids);
    addAttribute("instance", instances);
    addAttribute("v", velocities);
    addAttribute("pscale", radii);
    addAttribute("age", ages);
    addAttribute("Cd", albedos);
    if (areMedium) {
        std::vector<float> sections, temperatures, luminances, rates;
        std::vector<openvdb::Vec3f> streaks;
        for (const VoxelBall& ball : balls) {
            sections.push_back(float(ball.crossSection));
            temperatures.push_back(float(ball.temperature));
            luminances.push_back(float(ball.luminance));
            rates.push_back(float(ball.luminanceRate));
            streaks.emplace_back(float(ball.streak.x), float(ball.streak.y), float(ball.streak.z));
        }
        addAttribute("section", sections);
        addAttribute("temperature", temperatures);
        addAttribute("luminance", luminances);
        addAttribute("luminance_rate", rates);
        addAttribute("streak", streaks);
    }
    grid->setName("points");
    return grid;
}

namespace {

namespace points = openvdb::points;

/// The values of an attribute of a leaf.
template <class Value>
class Attribute
{
public:
    Attribute(const points::PointDataTree::LeafNodeType& leaf, const char* name)
    {
        const size_t at = leaf.attributeSet().find(name);
        if (at == points::AttributeSet::INVALID_POS)
            return;
        const points::AttributeArray& array = leaf.constAttributeArray(at);
        if (array.valueType() == openvdb::typeNameAsString<Value>() && array.stride() == 1)
            values_.emplace(array);
        size_ = array.size();
    }
    bool isThere(openvdb::Index64 count) const { return values_ && size_ >= count; }
    Value at(openvdb::Index point) const { return values_->get(point); }

private:
    std::optional<points::AttributeHandle<Value>> values_;
    openvdb::Index64 size_ = 0;
};

} // namespace

std::vector<VoxelBall> ballsOfPoints(const openvdb::GridBase& grid, const PointScales& scales,
                                     uint64_t& outDropped)
{
    const double scale = scales.length;
    const auto& data = dynamic_cast<const points::PointDataGrid&>(grid);
    const openvdb::math::Transform& transform = data.transform();
    const auto vector = [](const auto& v) { return glm::dvec3(double(v[0]), double(v[1]), double(v[2])); };
    std::vector<VoxelBall> balls;
    for (auto leaf = data.tree().cbeginLeaf(); leaf; ++leaf) {
        const Attribute<openvdb::Vec3f> place(*leaf, "P"), velocity(*leaf, "v"), albedo(*leaf, "Cd"),
            streak(*leaf, "streak");
        const Attribute<float> radius(*leaf, "pscale"), section(*leaf, "section"),
            temperature(*leaf, "temperature"), luminance(*leaf, "luminance"), age(*leaf, "age"),
            rate(*leaf, "luminance_rate");
        const Attribute<int64_t> id(*leaf, "id"), instance(*leaf, "instance");
        const openvdb::Index64 count = leaf->getLastValue();
        for (const auto* own : {&place, &velocity, &albedo, &streak})
            if (!own->isThere(count))
                return {};
        for (const auto* own : {&radius, &section, &temperature, &luminance})
            if (!own->isThere(count))
                return {};
        if (!id.isThere(count) || !instance.isThere(count))
            return {};
        if (balls.size() + count > kMostGridBalls)
            throw TooManyPoints();
        for (auto point = leaf->beginIndexOn(); point; ++point) {
            const openvdb::Index i = *point;
            if (i >= count)
                throw std::length_error("an index of a point");
            VoxelBall ball;
            ball.center = scale * vector(transform.indexToWorld(place.at(i) + point.getCoord().asVec3d()));
            ball.radius = scale * double(radius.at(i));
            ball.crossSection = scales.extinction * scale * scale * scale * double(section.at(i));
            ball.temperature = scales.temperature * double(temperature.at(i));
            ball.luminance = scales.luminance * double(luminance.at(i));
            // Files of other programs may have neither.
            if (age.isThere(count) && age.at(i) >= 0.0f && double(age.at(i)) < VoxelBall::kUnknownAge)
                ball.age = double(age.at(i));
            if (rate.isThere(count) && std::abs(double(rate.at(i))) <= VoxelBall::kMostRate)
                ball.luminanceRate = double(rate.at(i));
            ball.velocity = scale * vector(velocity.at(i));
            ball.albedo = vector(albedo.at(i));
            ball.streak = scale * vector(streak.at(i));
            ball.id = uint64_t(id.at(i));
            ball.instance = uint64_t(instance.at(i));
            if (isInRange(ball))
                balls.push_back(ball);
            else
                ++outDropped;
        }
    }
    return balls;
}

} // namespace fx::render
