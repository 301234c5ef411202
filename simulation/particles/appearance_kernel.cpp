#include "simulation/particles/appearance_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/particles/appearance_kernel.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "simulation/particles/appearance_lanes-inl.h"

#include <hwy/cache_control.h>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::particles::HWY_NAMESPACE {
namespace {

template <bool kBrief>
void writeBallistic(const AppearanceLanes& appearance, const AppearanceJob& job, const AppearanceColumns& out,
                    uint32_t begin, uint32_t end, AppearanceBounds& bounds)
{
    if (!job.program->plain)
        appearance.run<true, kBrief, false, false>(begin, end, bounds);
    else if (out.stream)
        appearance.run<true, kBrief, true, true>(begin, end, bounds);
    else
        appearance.run<true, kBrief, true, false>(begin, end, bounds);
}

AppearanceBounds writeAppearanceLanes(const AppearanceJob& job, const AppearanceColumns& out, uint32_t begin,
                                      uint32_t end)
{
    const AppearanceLanes appearance(job, out);
    AppearanceBounds bounds;
    const ParticleProgram& program = *job.program;
    if (program.ballistic)
        program.brief ? writeBallistic<true>(appearance, job, out, begin, end, bounds)
                      : writeBallistic<false>(appearance, job, out, begin, end, bounds);
    else
        program.brief ? appearance.run<false, true, false, false>(begin, end, bounds)
                      : appearance.run<false, false, false, false>(begin, end, bounds);
    if (out.stream)
        hwy::FlushStream();
    return bounds;
}

/// The columns that a program publishes, in the storage of a group.
class ColumnPlaces
{
public:
    explicit ColumnPlaces(const ParticleProgram& program)
    {
        namespace column = base::particle_column;
        const size_t rows = (std::max<size_t>(program.def.maxParticles, 1) + 15) / 16 * 16;
        size_t at = 0;
        for (size_t c = 0; c < column::Count; ++c)
            if ((program.published >> c & 1) != 0) {
                places_[c] = at;
                at += rows * base::columnElementSize(base::kParticleColumns[c].type) / sizeof(float);
            }
        published_ = program.published;
    }
    HWY_INLINE void point(float* storage, bool always, AppearanceColumns& out) const
    {
        namespace column = base::particle_column;
        out.x = storage + places_[column::PositionX];
        out.y = storage + places_[column::PositionY];
        out.z = storage + places_[column::PositionZ];
        out.age = storage + places_[column::Age];
        out.radius = storage + places_[column::Radius];
        out.color = reinterpret_cast<uint64_t*>(storage + places_[column::Color]);
        if (always)
            return;
        const auto floats = [&](size_t c) {
            return (published_ >> c & 1) != 0 ? storage + places_[c] : nullptr;
        };
        for (size_t a = 0; a < 3; ++a)
            out.velocity[a] = floats(column::VelocityX + a);
        out.angle = floats(column::Angle);
        out.frame = floats(column::Frame);
        for (size_t a = 0; a < 4; ++a)
            out.orientation[a] = floats(column::OrientationX + a);
    }

private:
    std::array<size_t, base::particle_column::Count> places_{};
    base::ColumnSet published_;
};

template <bool kBallistic, bool kBrief, bool kPlain>
void writeParts(std::span<AppearancePart> parts)
{
    AppearanceColumns out{};
    AppearanceLanes appearance(parts[0].job, out);
    MotionReader<kBallistic, kBrief> reader(parts[0].job);
    const ColumnPlaces places(*parts[0].job.program);
    for (AppearancePart& part : parts) {
        places.point(part.storage, kPlain, out);
        appearance.turnTo(part.job);
        reader.turnTo(part.job);
        appearance.runWith<kPlain, false>(reader, 0, part.job.rows.count, part.bounds);
    }
    AppearanceLanes::leaveVectors();
}

/// @param parts of one program
void writePartsLanes(std::span<AppearancePart> parts)
{
    const ParticleProgram& program = *parts[0].job.program;
    if (!program.ballistic)
        program.brief ? writeParts<false, true, false>(parts) : writeParts<false, false, false>(parts);
    else if (program.plain)
        program.brief ? writeParts<true, true, true>(parts) : writeParts<true, false, true>(parts);
    else
        program.brief ? writeParts<true, true, false>(parts) : writeParts<true, false, false>(parts);
}

template <bool kBallistic, bool kBrief>
void readTile(const AppearanceJob& job, uint32_t row, uint32_t count, MotionTile& out)
{
    const MotionReader<kBallistic, kBrief> reader(job);
    for (uint32_t i = 0; i < count; i += kWidth) {
        const MotionLanes motion = reader.template read<true, false>(row + i);
        for (uint32_t a = 0; a < 3; ++a) {
            hn::Store(motion.position[a], kFloats, out.position[a] + i);
            hn::Store(motion.velocity[a], kFloats, out.velocity[a] + i);
        }
        hn::Store(motion.age, kFloats, out.age + i);
        hn::Store(motion.life, kFloats, out.life + i);
    }
}

void readMotionLanes(const AppearanceJob& job, uint32_t row, uint32_t count, MotionTile& out)
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
HWY_EXPORT(writeAppearanceLanes);
HWY_EXPORT(writePartsLanes);
HWY_EXPORT(readMotionLanes);
} // namespace
} // namespace particles

void AppearanceBounds::add(const AppearanceBounds& other)
{
    for (int a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], other.low[a]);
        high[a] = std::max(high[a], other.high[a]);
    }
    radius = std::max(radius, other.radius);
}

base::Bounds AppearanceBounds::box() const
{
    base::Bounds box;
    if (low.x <= high.x) {
        box.add(low, radius);
        box.add(high, radius);
    }
    return box;
}

AppearanceBounds writeAppearance(const AppearanceJob& job, const AppearanceColumns& out, uint32_t begin,
                                 uint32_t end)
{
    using namespace particles;
    base::applyInstructionSetLimit();
    return HWY_DYNAMIC_DISPATCH(writeAppearanceLanes)(job, out, begin, end);
}

void writeManyAppearances(std::span<AppearancePart> parts)
{
    using namespace particles;
    base::applyInstructionSetLimit();
    for (size_t begin = 0, end = 0; begin < parts.size(); begin = end) {
        const ParticleProgram* const program = parts[begin].job.program;
        for (end = begin + 1; end < parts.size() && parts[end].job.program == program;)
            ++end;
        HWY_DYNAMIC_DISPATCH(writePartsLanes)(parts.subspan(begin, end - begin));
    }
}

void readMotion(const AppearanceJob& job, uint32_t row, uint32_t count, MotionTile& out)
{
    using namespace particles;
    base::applyInstructionSetLimit();
    HWY_DYNAMIC_DISPATCH(readMotionLanes)(job, row, count, out);
}

} // namespace fx::sim
#endif
