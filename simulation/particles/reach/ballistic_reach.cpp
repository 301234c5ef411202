// The reach of particles whose motion has a closed form.
#include "foundation/math/elementary.h"
#include "simulation/motion/drag_step.h"
#include "simulation/particles/particle_program.h"
#include "simulation/particles/reach/particle_reach.h"
#include "simulation/particles/shapes/shape_sample.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

constexpr float kRounding = 1e-5f; ///< of the box, more than float rounding of a place

/// Components between which directions of births lie.
void directionsOf(const EmitterSettings& def, glm::vec3& outLow, glm::vec3& outHigh)
{
    outLow = glm::vec3(-1.0f);
    outHigh = glm::vec3(1.0f);
    if (def.births) // they know their own
        return;
    if (def.shape == EmitterShape::Box)
        outLow = outHigh = glm::vec3(0.0f, 1.0f, 0.0f);
    if (def.shape != EmitterShape::Cone)
        return;
    const float angle = std::clamp(def.angle, 0.0f, 3.14159265f);
    const base::SinCos at = base::sinCosTurns(double(angle) / 6.283185307179586);
    const float side = angle < 1.57f ? float(at.sin) : 1.0f;
    outLow = {-side, float(at.cos), -side};
    outHigh = {side, 1.0f, side};
}

/// [m] No birth is farther from the shape's position.
float farthestOf(const ShapeOp& births)
{
    const ShapeDef* const shape = shapeOf(births);
    if (!shape)
        return 0.0f;
    const auto slope = float(slopeOf(*shape));
    return glm::length(shape->size) + shape->tube +
           std::max(shape->height, 0.0f) * std::sqrt(1.0f + slope * slope);
}

float largestOf(const base::ScalarCurve& curve)
{
    float most = 0;
    for (size_t i = 0; i <= base::kCurveSamples; ++i)
        most = std::max(most, curve.at(float(i) / float(base::kCurveSamples))[0]);
    return most;
}

/// [m] What is drawn of a particle lies so near to its center, whose speed is at most `speed`.
float reachOfOne(const EmitterSettings& def, float speed)
{
    const float bySpeed = def.appearance.fastest > 0.0f ? largestOf(def.appearance.sizeOverSpeed) : 1.0f;
    const float size = std::max(largestOf(def.sizeOverLife) * bySpeed, 1e-4f);
    return std::max(def.radius.min, def.radius.max) * size * cornerOf(def.appearance) +
           0.5f * def.appearance.stretch * speed;
}

} // namespace

/// A place is x0 + G v0 + the pulls so far, weighted by numbers >= 0 whose sum is R; G and R only grow with
/// age.
base::Bounds boundsOfAll(const EmitterSettings& def, const glm::vec3& low, const glm::vec3& high,
                         float seconds, float secondsBack)
{
    const float drag = def.forces.drag > 0.0f ? std::min(def.forces.drag, 1e6f) : 0.0f;
    const DragStep step = makeDragStep(double(drag), double(seconds));
    const float gain = step.gain, ramp = step.ramp;
    glm::vec3 size(0.0f);
    if (def.births)
        size = glm::vec3(farthestOf(*def.births));
    else if (def.shape == EmitterShape::Box)
        size = glm::abs(def.size);
    else if (def.shape != EmitterShape::Point)
        size = std::abs(def.size.x) * (def.shape == EmitterShape::Cone ? glm::vec3(1, 0, 1) : glm::vec3(1));
    glm::vec3 lowest, highest;
    directionsOf(def, lowest, highest);
    const float slow = std::min(def.speed.min, def.speed.max), fast = std::max(def.speed.min, def.speed.max);
    const glm::vec3 from =
        gain * glm::min(glm::min(slow * lowest, slow * highest), glm::min(fast * lowest, fast * highest));
    const glm::vec3 to =
        gain * glm::max(glm::max(slow * lowest, slow * highest), glm::max(fast * lowest, fast * highest));
    const glm::vec3 zero(0.0f);
    base::Bounds box;
    box.min = def.position - size + glm::min(from, zero) + ramp * glm::min(low, zero);
    box.max = def.position + size + glm::max(to, zero) + ramp * glm::max(high, zero);
    const float pull = glm::length(glm::max(glm::abs(low), glm::abs(high)));
    const float speed = std::max(std::abs(slow), std::abs(fast)) + gain * pull;
    float more = reachOfOne(def, speed) + kRounding * glm::length(box.max - box.min);
    if (def.appearance.alignment == base::SpriteAlignment::Velocity || def.appearance.stretch > 0.0f) {
        // Particles born since the snapshot before are drawn on the tangent of their path.
        const float back = std::min(seconds, secondsBack);
        more += 0.5f * (pull + drag * speed) * back * back;
    }
    box.min -= more;
    box.max += more;
    return box;
}

} // namespace fx::sim
