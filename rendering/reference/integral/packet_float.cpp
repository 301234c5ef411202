#include "rendering/reference/integral/packet_job.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rendering/reference/integral/packet_float.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "rendering/reference/integral/packet_integral-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fx::render::integral::HWY_NAMESPACE {
namespace {

void integrateInFloats(const PacketJob<float>& job)
{
    integratePacket<float>(job);
}
uint64_t meetInFloats(const MeetJob<float>& job)
{
    return meetBallsOf<float>(job);
}

} // namespace
} // namespace fx::render::integral::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::render::integral {

namespace {
HWY_EXPORT(integrateInFloats);
HWY_EXPORT(meetInFloats);
} // namespace

void integrateFloats(const PacketJob<float>& job)
{
    base::applyInstructionSetLimit();
    HWY_DYNAMIC_DISPATCH(integrateInFloats)(job);
}
uint64_t meetFloats(const MeetJob<float>& job)
{
    base::applyInstructionSetLimit();
    return HWY_DYNAMIC_DISPATCH(meetInFloats)(job);
}

} // namespace fx::render::integral
#endif
