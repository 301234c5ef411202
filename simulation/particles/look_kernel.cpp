#include "simulation/particles/look_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/particles/look_kernel.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "simulation/particles/look_lanes-inl.h"

#include <hwy/cache_control.h>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::particles::HWY_NAMESPACE {
namespace {

template <bool kBrief>
void writeBallistic(const Looks& looks, const LookJob& job, const LookColumns& out, uint32_t begin,
                    uint32_t end, LookBounds& bounds)
{
    if (!job.program->plain)
        looks.run<true, kBrief, false, false>(begin, end, bounds);
    else if (out.stream)
        looks.run<true, kBrief, true, true>(begin, end, bounds);
    else
        looks.run<true, kBrief, true, false>(begin, end, bounds);
}

LookBounds writeLooksLanes(const LookJob& job, const LookColumns& out, uint32_t begin, uint32_t end)
{
    const Looks looks(job, out);
    LookBounds bounds;
    const ParticleProgram& program = *job.program;
    if (program.ballistic)
        program.brief ? writeBallistic<true>(looks, job, out, begin, end, bounds)
                      : writeBallistic<false>(looks, job, out, begin, end, bounds);
    else
        program.brief ? looks.run<false, true, false, false>(begin, end, bounds)
                      : looks.run<false, false, false, false>(begin, end, bounds);
    if (out.stream)
        hwy::FlushStream();
    return bounds;
}

template <bool kBallistic, bool kBrief>
void readTile(const LookJob& job, uint32_t row, uint32_t count, MotionTile& out)
{
    const MotionReader<kBallistic, kBrief> reader(job);
    for (uint32_t i = 0; i < count; i += kWidth) {
        const MotionLanes motion = reader.template read<true>(row + i);
        for (uint32_t a = 0; a < 3; ++a) {
            hn::Store(motion.position[a], kFloats, out.position[a] + i);
            hn::Store(motion.velocity[a], kFloats, out.velocity[a] + i);
        }
        hn::Store(motion.age, kFloats, out.age + i);
        hn::Store(motion.life, kFloats, out.life + i);
    }
}

void readMotionLanes(const LookJob& job, uint32_t row, uint32_t count, MotionTile& out)
{
    const ParticleProgram& program = *job.program;
    if (program.ballistic)
        program.brief ? readTile<true, true>(job, row, count, out)
                      : readTile<true, false>(job, row, count, out);
    else
        program.brief ? readTile<false, true>(job, row, count, out)
                      : readTile<false, false>(job, row, count, out);
}

} // namespace
} // namespace fx::sim::particles::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

namespace particles {
namespace {
HWY_EXPORT(writeLooksLanes);
HWY_EXPORT(readMotionLanes);
} // namespace
} // namespace particles

void LookBounds::add(const LookBounds& other)
{
    for (int a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], other.low[a]);
        high[a] = std::max(high[a], other.high[a]);
    }
    radius = std::max(radius, other.radius);
}

base::Bounds LookBounds::box() const
{
    base::Bounds box;
    if (low.x <= high.x) {
        box.add(low, radius);
        box.add(high, radius);
    }
    return box;
}

LookBounds writeLooks(const LookJob& job, const LookColumns& out, uint32_t begin, uint32_t end)
{
    using namespace particles;
    base::applyInstructionSetLimit();
    return HWY_DYNAMIC_DISPATCH(writeLooksLanes)(job, out, begin, end);
}

void readMotion(const LookJob& job, uint32_t row, uint32_t count, MotionTile& out)
{
    using namespace particles;
    base::applyInstructionSetLimit();
    HWY_DYNAMIC_DISPATCH(readMotionLanes)(job, row, count, out);
}

} // namespace fx::sim
#endif
