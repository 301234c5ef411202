/// @file detail_scenes.h
/// Balls of medium whose field has detail, for tests of the renderers without a GPU.
#pragma once

#include "rendering/field_detail/detailed_field.h"
#include "rendering/reference/render/reference_scene.h"
#include "tests/rendering/reference/trace/ball_scenes.h"

#include <vector>

namespace fx::test {

inline render::FieldDetailNumbers someDetail()
{
    render::FieldDetailNumbers numbers;
    numbers.generations[0] = {0.4f, 1.0f, {1.3f, 6.2f, 4.4f}};
    numbers.generations[1] = {0.35f, 1.0f, {3.1f, 0.2f, 7.7f}};
    numbers.fade = 0.35f;
    numbers.thinnest = 0.1f;
    numbers.densest = 4.0f;
    return numbers;
}

/// Detail of balls around the origin that belong to one group.
inline render::MediumDetails detailsOf(std::span<const render::MediumBlob> blobs,
                                       const render::FieldDetailNumbers& numbers, float temperature = 0.0f)
{
    render::MediumDetails details;
    render::MediumDetails::Group group;
    group.detail.numbers = numbers;
    for (size_t g = 0; g < 2; ++g) {
        group.detail.toCells[g] = glm::mat3(1.0f / numbers.generations[g].length);
        group.detail.first[g] = numbers.generations[g].offset;
    }
    group.detail.factor = 1.1f;
    details.groups.push_back(group);
    Chance chance(5);
    for (size_t i = 0; i < blobs.size(); ++i) {
        render::MediumDetails::Ball ball{0, {}, temperature};
        for (glm::vec3& carried : ball.carried)
            carried = glm::vec3(0.3 * chance.inCube());
        details.balls.push_back(ball);
    }
    return details;
}

/// The field of detailsOf() for evaluation at single points, without the conservation factor.
inline render::DetailedField fieldOf(std::span<const render::MediumBlob> blobs,
                                     const render::MediumDetails& details, const render::LumpTile& tile)
{
    const render::FieldDetailNumbers& numbers = details.groups[0].detail.numbers;
    std::vector<render::DetailedBall> balls;
    for (size_t i = 0; i < blobs.size(); ++i) {
        render::DetailedBall ball{
            glm::vec3(blobs[i].center), float(blobs[i].radius), float(blobs[i].crossSection), {}};
        for (size_t g = 0; g < 2; ++g)
            ball.place[g] =
                numbers.generations[g].length * details.balls[i].carried[g] + glm::vec3(blobs[i].center);
        balls.push_back(ball);
    }
    return {balls, numbers, tile};
}

} // namespace fx::test
