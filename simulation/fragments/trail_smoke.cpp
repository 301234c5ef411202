#include "simulation/fragments/trail_smoke.h"

#include "foundation/random/philox.h"
#include "simulation/motion/ambient_air.h"
#include "simulation/motion/blob_optics.h"
#include "simulation/motion/drag_step.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

namespace column = trail_column;
using base::RandomPurpose;

constexpr float kMaxBlobs = 1e6f; // of one fragment in one step

CurlNoise makeNoise(const TrailDef& def, const StepContext& step)
{
    const base::Random4 words =
        base::philox({1, 0, step.solverIndex, uint32_t(RandomPurpose::Noise)}, step.seed);
    return {words[0], def.curlStrength, def.curlScale, base::toSeconds(step.tick) * double(def.curlRate)};
}

/// Mean of T / T_a - 1 over `seconds` from age `age`: (4), integrated.
float meanExcess(const TrailDef& def, double age, double seconds)
{
    const double first = double(def.temperature) / double(kAirTemperature) - 1.0;
    const double q = double(def.mixing);
    const double start = first * base::naturalExp(-q * age);
    const double z = q * seconds;
    return float(z < 1e-4 ? start * (1.0 - 0.5 * z) : start * (1.0 - base::naturalExp(-z)) / z);
}

/// (6)
void moveBlob(const TrailStep& s, TrailStore& trail, uint32_t i, base::Ticks from)
{
    const TrailDef& def = s.def.trail;
    const double seconds = base::toSeconds(s.end - from);
    const double age = base::toSeconds(from - trail.born[i]);
    const glm::vec3 position{trail.at(column::X)[i], trail.at(column::Y)[i], trail.at(column::Z)[i]};
    const glm::vec3 velocity{trail.at(column::VelocityX)[i], trail.at(column::VelocityY)[i],
                             trail.at(column::VelocityZ)[i]};
    const glm::vec3 air = s.noise.active() ? s.step.wind + s.noise.velocity(position) : s.step.wind;
    const glm::vec3 lift = -def.buoyancy * meanExcess(def, age, seconds) * s.step.gravity;
    const DragStep drag = makeDragStep(double(def.drag), seconds);
    const glm::vec3 x = position + drag.gain * velocity + drag.drift * air + drag.ramp * lift;
    const glm::vec3 v = drag.decay * velocity + drag.share * air + drag.gain * lift;
    trail.at(column::X)[i] = x.x;
    trail.at(column::Y)[i] = std::max(x.y, s.step.groundHeight);
    trail.at(column::Z)[i] = x.z;
    trail.at(column::VelocityX)[i] = v.x;
    trail.at(column::VelocityY)[i] = v.y;
    trail.at(column::VelocityZ)[i] = v.z;
}

} // namespace

TrailStep::TrailStep(const FragmentsDef& definition, const StepContext& context)
    : def(definition), step(context), end(context.tick + context.stepTicks),
      noise(makeNoise(definition.trail, context))
{}

uint32_t blobsAlong(float length, float due, float spacing)
{
    if (!(spacing > 0.0f) || !(length >= due))
        return 0;
    return uint32_t(std::min((length - due) / spacing, kMaxBlobs)) + 1; // (1)
}

void emitSmoke(const TrailStep& s, const FragmentStore& fragments, uint32_t row, const FragmentWay& way,
               base::Ticks begin, const SmokeRows& rows, TrailStore& trail)
{
    const TrailDef& def = s.def.trail;
    const float thickness = std::sqrt(fragments.at(fragment_column::Size)[row] / s.def.size.max);
    const float heat = (fragments.at(fragment_column::Temperature)[row] - def.coldest) /
                       std::max(fragments.at(fragment_column::Hottest)[row] - def.coldest, 1.0f);
    for (uint32_t i = rows.begin; i < rows.end; ++i) {
        const uint32_t j = i - way.first;
        const uint64_t id = trailId(fragments.number[row], fragments.trailed[row] + j);
        const std::array<float, 4> u =
            base::randomUnit4(s.step.seed, s.step.solverIndex, id, RandomPurpose::Gas);
        const float f = std::min((way.due + float(j) * def.spacing) / way.length, 1.0f); // (1)
        const glm::vec3 place = way.from.position + f * (way.to.position - way.from.position);
        const glm::vec3 velocity =
            def.inherited * (way.from.velocity + f * (way.to.velocity - way.from.velocity));
        trail.id[i] = id;
        trail.born[i] = begin + base::Ticks(double(f) * double(s.end - begin));
        trail.dies[i] =
            trail.born[i] + std::max(base::toTicks(double(def.lifetime.at(u[0]))), base::Ticks(1));
        trail.at(column::X)[i] = place.x;
        trail.at(column::Y)[i] = place.y;
        trail.at(column::Z)[i] = place.z;
        trail.at(column::VelocityX)[i] = velocity.x;
        trail.at(column::VelocityY)[i] = velocity.y;
        trail.at(column::VelocityZ)[i] = velocity.z;
        const float radius = def.radius.at(u[1]) * thickness;
        trail.at(column::Radius)[i] = radius;
        trail.at(column::CrossSection)[i] =
            crossSectionOf(def.opticalDepth * std::clamp(heat, 0.0f, 1.0f) * (0.5f + u[2]), radius);
        moveBlob(s, trail, i, trail.born[i]);
    }
}

void moveSmoke(const TrailStep& s, TrailStore& trail, uint32_t begin, uint32_t end)
{
    for (uint32_t i = begin; i < end; ++i)
        moveBlob(s, trail, i, s.step.tick);
}

SmokeAppearance smokeAppearance(const TrailDef& def, float radius, float age, float lifetime)
{
    const float part = std::clamp(age / lifetime, 0.0f, 1.0f);
    const float left = 1.0f - part * part;
    const float cooled = float(base::naturalExp(-double(def.mixing) * double(age)));
    return {std::sqrt(radius * radius + def.spreading * age),
            kAirTemperature + (def.temperature - kAirTemperature) * cooled, left * left};
}

} // namespace fx::sim
