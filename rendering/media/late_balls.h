/// @file late_balls.h
/// Balls that a technique gathers in place of the rows of a late group, so that the rows need not be
/// computed.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/field_detail/blob_detail.h"
#include "rendering/lights/medium_caster.h"
#include "rendering/media/gathered_blob.h"

#include <span>

namespace fx::render {

/// The balls of one late group.
struct LateBalls
{
    base::GroupName name;
    std::span<const GatheredBlob> visible; ///< that touch the view
    std::span<const MediumCaster> casters; ///< all that cast shadows
    const GroupDetail* detail = nullptr;   ///< of their field; null: none
};

} // namespace fx::render
