/// @file order_members.h
/// Members of a preset that say in which order particles are drawn. They need the composition "sorted": a sum
/// has no order.
#pragma once

#include "simulation/solver/effect_def.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace fx::preset {

struct OrderMember
{
    std::string pointer; ///< in the preset
    std::string text;    ///< the member as it is written, without blanks
};

/// The members "order" with "oldest" or "youngest" and "orderBias" other than 0, by ascending pointer.
/// @param preset valid
std::vector<OrderMember> orderMembers(const nlohmann::json& preset);

/// Text of the warning about such a member, without a remedy.
std::string orderWarning(const OrderMember& member);

/// Whether `composition` sums media, so that their order has no effect.
inline bool sumsUp(sim::PreferredComposition composition)
{
    return composition > sim::PreferredComposition::Sorted;
}

} // namespace fx::preset
