#include "rendering/field_detail/detailed_field.h"

#include "foundation/math/geometry.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/material_kind.h"
#include "shaders/formulas/formula.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace fx::render {

namespace {

float extinctionOf(const DetailedBall& ball, const glm::vec3& away)
{
    return formula::fxKernelExtinction(ball.crossSection, ball.radius, glm::dot(away, away));
}

} // namespace

DetailedField::DetailedField(std::vector<DetailedBall> balls, const FieldDetailNumbers& numbers,
                             const LumpTile& tile)
    : balls_(std::move(balls)), numbers_(numbers), tile_(tile)
{}

SmoothMedium DetailedField::smoothAt(const glm::vec3& point) const
{
    SmoothMedium sum{0.0f, {glm::vec3(0.0f), glm::vec3(0.0f)}, 0.0f};
    for (const DetailedBall& ball : balls_) {
        const glm::vec3 away = point - ball.center;
        const float extinction = extinctionOf(ball, away);
        if (extinction == 0.0f)
            continue;
        sum.extinction += extinction;
        sum.thinning += extinction * thinningOf(numbers_, ball.crossSection, ball.radius);
        for (size_t g = 0; g < 2; ++g)
            sum.place[g] += extinction * (numbers_.generations[g].growth * away + ball.place[g]);
    }
    for (glm::vec3& place : sum.place)
        place /= std::max(sum.extinction, 1e-30f);
    sum.thinning /= std::max(sum.extinction, 1e-30f);
    return sum;
}

MediumDetail DetailedField::at(const glm::vec3& point, float pixel, int octaves) const
{
    return detailAt(numbers_, tile_, smoothAt(point), pixel, octaves);
}

float DetailedField::extinctionAt(const glm::vec3& point, float pixel, int octaves) const
{
    const SmoothMedium smooth = smoothAt(point);
    return factor_ * smooth.extinction * detailAt(numbers_, tile_, smooth, pixel, octaves).share;
}

void DetailedField::conserveIntegral(float spacing)
{
    base::Bounds box;
    for (const DetailedBall& ball : balls_)
        box.add(ball.center, ball.radius);
    double before = 0, after = 0;
    for (float z = box.min.z; z <= box.max.z; z += spacing)
        for (float y = box.min.y; y <= box.max.y; y += spacing)
            for (float x = box.min.x; x <= box.max.x; x += spacing) {
                const SmoothMedium smooth = smoothAt({x, y, z});
                const float left = detailAt(numbers_, tile_, smooth, 0.5f * spacing, kMaxDetailOctaves).share;
                before += double(smooth.extinction);
                after += double(smooth.extinction) * double(left);
            }
    factor_ = after > 0.0 ? float(before / after) : 1.0f;
}

std::vector<DetailedBall> detailedBalls(const base::SnapshotGroup& blobs, const base::SnapshotGroup& material)
{
    const auto vector = [](const base::SnapshotGroup& group, size_t column, uint32_t i) {
        return glm::vec3(group.column(column)[i], group.column(column + 1)[i], group.column(column + 2)[i]);
    };
    std::vector<DetailedBall> balls(blobs.count());
    for (uint32_t i = 0; i < blobs.count(); ++i) {
        balls[i].center = vector(blobs, base::blob_column::PositionX, i);
        balls[i].radius = blobs.column(base::blob_column::Radius)[i];
        balls[i].crossSection = blobs.column(base::blob_column::CrossSection)[i];
        balls[i].place[0] = vector(material, base::material_column::Place0X, i);
        balls[i].place[1] = vector(material, base::material_column::Place1X, i);
    }
    return balls;
}

} // namespace fx::render
