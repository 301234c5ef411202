#include "tests/rendering/field/field_scenes.h"

#include "foundation/random/philox.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace fx::test {

using namespace render;

namespace {

/// Smaller balls have a quarter of the cross section.
float quarterRadius(std::span<const BlobInstance> balls)
{
    std::vector<std::pair<float, float>> radii;
    float left = 0.0f, radius = 0.0f;
    for (const BlobInstance& ball : balls) {
        radii.push_back({ball.centerRadius.w, ball.medium.x});
        left += 0.25f * ball.medium.x;
    }
    std::ranges::sort(radii);
    for (size_t i = 0; i < radii.size() && left > 0.0f; left -= radii[i++].second)
        radius = radii[i].first;
    return radius;
}

} // namespace

FieldScene::FieldScene(const std::vector<FieldBall>& world, const CameraView& view)
    : camera(cameraGeometry(view))
{
    std::vector<FieldBall> ordered = world;
    std::ranges::stable_sort(ordered, {}, &FieldBall::effect);
    for (const FieldBall& ball : ordered) {
        BlobInstance blob{};
        const glm::vec3 center(ball.center - camera.eye);
        blob.centerRadius = {center, ball.radius};
        blob.medium = {ball.crossSection, 0.0f, 0.0f, 0.0f};
        blob.scatter = {ball.albedo, ball.meanCosine};
        blob.layer = {float(ball.layer) * 2.0f + ball.fireShare, 0.0f, 0.0f, 0.0f};
        blob.emission = {ball.emission, 0.0f};
        blob.lit = {center, 0.0f};
        balls.push_back(blob);
        const float most = std::numeric_limits<float>::max();
        const uint32_t count = uint32_t(balls.size());
        while (effects.size() <= ball.effect)
            effects.push_back({count - 1, count - 1, glm::vec3(most), glm::vec3(-most), 0.0f});
        effects[ball.effect].end = count;
        BlobEffect& effect = effects[ball.effect];
        effect.low = glm::min(effect.low, center - ball.radius);
        effect.high = glm::max(effect.high, center + ball.radius);
    }
    for (BlobEffect& effect : effects)
        effect.radius = quarterRadius(std::span(balls).subspan(effect.begin, effect.end - effect.begin));
}

FieldPlanInputs FieldScene::inputs(int width, int height, int resolution) const
{
    return {balls, effects, &camera, width, height, resolution, 0};
}

std::vector<FieldBall> randomBalls(uint32_t count, uint64_t seed, const glm::dvec3& middle, uint32_t effect)
{
    std::vector<FieldBall> balls;
    for (uint32_t i = 0; i < count; ++i) {
        const auto u = base::randomUnit4(seed, 0, i, base::RandomPurpose::Position);
        const auto v = base::randomUnit4(seed, 0, i, base::RandomPurpose::Attributes);
        FieldBall ball;
        ball.center = middle + glm::dvec3(4.0 * u[0] - 2.0, 3.0 * u[1] - 1.5, 4.0 * u[2] - 2.0);
        ball.radius = 0.3f + 0.7f * v[0];
        ball.crossSection = 0.3f * v[1] * ball.radius * ball.radius;
        ball.emission = {4.0f * v[2], 2.0f * v[3], v[2] * v[3]};
        ball.albedo = {v[3], 0.5f * v[3], 0.2f};
        ball.meanCosine = 0.8f * v[1];
        ball.layer = i % 3;
        ball.fireShare = v[0];
        ball.effect = effect;
        balls.push_back(ball);
    }
    return balls;
}

double sumAt(const FieldScene& scene, uint32_t effect, const glm::dvec3& place, const FieldBlock& field,
             const std::vector<double>& weights)
{
    double sum = 0.0;
    for (size_t i = scene.effects[effect].begin; i < scene.effects[effect].end; ++i) {
        const BlobInstance& ball = scene.balls[i];
        const double radius = std::max(ball.centerRadius.w, field.limits.x);
        const glm::dvec3 d = place - glm::dvec3(ball.centerRadius);
        const double s2 = glm::dot(d, d) / (radius * radius);
        if (s2 >= 1.0)
            continue;
        const double h = double(field.corner.w) / radius;
        const double laplace = 20.0 * s2 - 12.0; // voxel-kernel (2)
        const double shape = (1.0 - s2) * (1.0 - s2) - h * h * (1.0 - 4.0 * h * h) / 12.0 * laplace;
        sum += (weights.empty() ? 1.0 : weights[i]) * 105.0 / (32.0 * 3.14159265358979) *
               double(ball.medium.x) / (radius * radius * radius) * shape;
    }
    return sum;
}

double sampleAt(const FieldScene& scene, uint32_t effect, const glm::dvec3& place, const FieldBlock& field)
{
    return std::max(sumAt(scene, effect, place, field), 0.0);
}

glm::dvec3 placeOfSample(const FieldPlan& plan, const FieldBrickBlock& brick, const glm::ivec3& s)
{
    const FieldBlock& field = plan.fields()[brick.field];
    const glm::ivec3 place(brick.place & 1023u, brick.place >> 10 & 1023u, brick.place >> 20);
    return glm::dvec3(field.corner) + double(field.corner.w) * glm::dvec3(kBrickCells * place + s);
}

} // namespace fx::test
