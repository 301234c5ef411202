#include "simulation/emitters/emitter_motion.h"

#include "foundation/random/philox.h"
#include "simulation/emitters/birth_shape.h"
#include "simulation/motion/blob_optics.h"
#include "simulation/motion/drag_step.h"
#include "simulation/motion/ground_contact.h"

#include <algorithm>

namespace fx::sim {

namespace {

namespace column = emitter_column;
using base::RandomPurpose;

constexpr float kSmallestBirthScale = 0.1f; // a curve that starts at size 0 still defines an optical depth

CurlNoise makeNoise(const EmitterDef& def, const StepContext& step)
{
    const base::Random4 words =
        base::philox({0, 0, step.solverIndex, uint32_t(RandomPurpose::Noise)}, step.seed);
    const double turns = base::toSeconds(step.tick) * double(def.forces.curlRate);
    return {words[0], def.forces.curlStrength, def.forces.curlScale, turns};
}

/// NaN and negative lives are none; a range of one value may be infinite.
base::Ticks lifeTicks(const base::Range& range, float u)
{
    const float seconds = range.max > range.min ? range.at(u) : range.min;
    return seconds > 0.0f ? base::toTicks(std::min(double(seconds), 1e9)) : 0;
}

void createParticle(const EmitterStep& s, EmitterStore& store, uint32_t i)
{
    const EmitterDef& def = s.def;
    const auto draw = [&](RandomPurpose purpose) {
        return base::randomUnit4(s.step.seed, s.step.solverIndex, store.index[i], purpose);
    };
    const std::array<float, 4> life = draw(RandomPurpose::Life);
    const std::array<float, 4> looks = draw(RandomPurpose::Attributes);
    const BirthPlace place = sampleBirth(def, draw(RandomPurpose::Position), draw(RandomPurpose::Direction));
    const float speed = def.speed.at(life[1]);
    const float radius = def.radius.at(looks[0]);
    const float amount = def.crossSection.at(looks[1]);
    const float birthScale = std::max(def.sizeOverLife.at(0.0f)[0], kSmallestBirthScale);

    store.dies[i] = store.born[i] + lifeTicks(def.lifetime, life[0]);
    store.at(column::X)[i] = place.position.x;
    store.at(column::Y)[i] = place.position.y;
    store.at(column::Z)[i] = place.position.z;
    store.at(column::VelocityX)[i] = speed * place.direction.x;
    store.at(column::VelocityY)[i] = speed * place.direction.y;
    store.at(column::VelocityZ)[i] = speed * place.direction.z;
    store.at(column::Radius)[i] = radius;
    store.at(column::CrossSection)[i] =
        def.opticalDepthGiven ? crossSectionOf(amount, radius * birthScale) : amount;
    store.at(column::Excess)[i] = def.temperature.at(looks[2]) - kAirTemperature;
}

/// The air around each particle: wind, and turbulence where there is any.
void sampleAir(const EmitterStep& s, const EmitterStore& store, std::span<glm::vec3> air, uint32_t begin,
               uint32_t end)
{
    for (uint32_t i = begin; i < end; ++i)
        air[i] = s.wind;
    if (!s.noise.active())
        return;
    for (uint32_t i = begin; i < end; ++i)
        air[i] += s.noise.velocity({store.at(column::X)[i], store.at(column::Y)[i], store.at(column::Z)[i]});
}

/// Gravity minus buoyancy, as a multiple of the world's gravity.
void weigh(const EmitterStep& s, const EmitterStore& store, std::span<float> weight, uint32_t begin,
           uint32_t end)
{
    const EmitterForces& forces = s.def.forces;
    for (uint32_t i = begin; i < end; ++i)
        weight[i] = forces.gravity;
    if (forces.buoyancy == 0.0f)
        return;
    for (uint32_t i = begin; i < end; ++i) {
        const float t = lifeFraction(store, i, std::max(s.step.tick, store.born[i]));
        const float excess = store.at(column::Excess)[i] * s.def.temperatureOverLife.at(t)[0];
        weight[i] -= forces.buoyancy * excess / kAirTemperature; // (T / T_air - 1) g upwards
    }
}

MotionState fly(const MotionState& from, const glm::vec3& acceleration, const glm::vec3& air,
                const DragStep& drag)
{
    return {from.position + drag.gain * from.velocity + drag.drift * air + drag.ramp * acceleration,
            drag.decay * from.velocity + drag.share * air + drag.gain * acceleration};
}

} // namespace

EmitterStep::EmitterStep(const EmitterDef& definition, const StepContext& context)
    : def(definition), step(context), end(context.tick + context.stepTicks),
      wind(context.wind + definition.forces.wind), noise(makeNoise(definition, context))
{}

float lifeFraction(const EmitterStore& store, uint32_t i, base::Ticks tick)
{
    const base::Ticks life = store.dies[i] - store.born[i];
    return life > 0 ? float(double(tick - store.born[i]) / double(life)) : 1.0f;
}

void createParticles(const EmitterStep& step, EmitterStore& store, uint32_t begin, uint32_t end)
{
    for (uint32_t i = begin; i < end; ++i)
        createParticle(step, store, i);
}

void moveParticles(const EmitterStep& s, EmitterStore& store, const EmitterScratch& scratch, uint32_t begin,
                   uint32_t end)
{
    sampleAir(s, store, scratch.air, begin, end);
    weigh(s, store, scratch.weight, begin, end);

    const EmitterForces& forces = s.def.forces;
    const DragStep whole = makeDragStep(double(forces.drag), base::toSeconds(s.step.stepTicks));
    const bool hitsGround = forces.bounce >= 0.0f;
    const GroundContact ground{s.step.groundHeight, std::min(forces.bounce, 1.0f),
                               std::clamp(forces.friction, 0.0f, 1.0f)};
    float* const x = store.at(column::X);
    float* const y = store.at(column::Y);
    float* const z = store.at(column::Z);
    float* const vx = store.at(column::VelocityX);
    float* const vy = store.at(column::VelocityY);
    float* const vz = store.at(column::VelocityZ);
    for (uint32_t i = begin; i < end; ++i) {
        const DragStep drag = store.born[i] <= s.step.tick
                                  ? whole
                                  : makeDragStep(double(forces.drag), base::toSeconds(s.end - store.born[i]));
        const MotionState before{{x[i], y[i], z[i]}, {vx[i], vy[i], vz[i]}};
        MotionState after = fly(before, scratch.weight[i] * s.step.gravity, scratch.air[i], drag);
        if (hitsGround)
            after = bounce(before, after, drag.seconds, ground);
        if (hitsGround && s.step.collider)
            s.step.collider->bounce(before.position, after.position, after.velocity,
                                    {0.0f, ground.restitution, ground.friction}, float(drag.seconds));
        x[i] = after.position.x;
        y[i] = after.position.y;
        z[i] = after.position.z;
        vx[i] = after.velocity.x;
        vy[i] = after.velocity.y;
        vz[i] = after.velocity.z;
    }
}

} // namespace fx::sim
