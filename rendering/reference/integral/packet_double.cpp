#include "rendering/reference/integral/packet_job.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rendering/reference/integral/packet_double.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "rendering/reference/integral/packet_integral-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fx::render::integral::HWY_NAMESPACE {
namespace {

void integrateInDoubles(const PacketJob<double>& job)
{
    integratePacket<double>(job);
}
uint64_t meetInDoubles(const MeetJob<double>& job)
{
    return meetBallsOf<double>(job);
}

} // namespace
} // namespace fx::render::integral::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::render::integral {

namespace {
HWY_EXPORT(integrateInDoubles);
HWY_EXPORT(meetInDoubles);
} // namespace

void integrateDoubles(const PacketJob<double>& job)
{
    base::applyInstructionSetLimit();
    HWY_DYNAMIC_DISPATCH(integrateInDoubles)(job);
}
uint64_t meetDoubles(const MeetJob<double>& job)
{
    base::applyInstructionSetLimit();
    return HWY_DYNAMIC_DISPATCH(meetInDoubles)(job);
}

} // namespace fx::render::integral
#endif
