/// @file field_scenes.h
/// Balls of medium in the world for tests of voxel fields, and exact sums over balls.
#pragma once

#include "rendering/field/field_plan.h"
#include "rendering/frame/view_types.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace fx::test {

struct FieldBall
{
    glm::dvec3 center{0.0}; ///< [m] position of the center in the world
    float radius = 1.0f;
    float crossSection = 1.0f;
    glm::vec3 emission{0.0f}; ///< emitted light, exposed
    glm::vec3 albedo{0.0f};
    float meanCosine = 0.0f;
    uint32_t layer = 1; ///< layer of the ball; 1: smoke
    float fireShare = 0.0f;
    uint32_t effect = 0;
};

/// Inputs of a plan, in the form in which a view gathers them.
struct FieldScene
{
    std::vector<render::BlobInstance> balls;
    std::vector<render::BlobEffect> effects;
    render::CameraGeometry camera;

    /// Groups the balls by effect. Within an effect, the order of balls does not change.
    FieldScene(const std::vector<FieldBall>& world, const render::CameraView& view);
    render::FieldPlanInputs inputs(int width, int height, int resolution) const;
};

/// Balls in a box of a few meters around `middle`, of one effect.
std::vector<FieldBall> randomBalls(uint32_t count, uint64_t seed, const glm::dvec3& middle,
                                   uint32_t effect = 0);

/// [1/m] Sum of the extinction of all balls of an effect, in double precision, at a position relative to the
/// eye. The extinction of each ball is multiplied by its weight, or by 1 if there are no weights.
double sumAt(const FieldScene& scene, uint32_t effect, const glm::dvec3& place,
             const render::FieldBlock& field, const std::vector<double>& weights = {});
/// [1/m] Result of sumAt() without weights, clamped to 0 like a stored sample.
double sampleAt(const FieldScene& scene, uint32_t effect, const glm::dvec3& place,
                const render::FieldBlock& field);

/// [m] Position of a sample of a brick, relative to the eye.
glm::dvec3 placeOfSample(const render::FieldPlan& plan, const render::FieldBrickBlock& brick,
                         const glm::ivec3& s);

} // namespace fx::test
