/// @file order_members.h
/// Members of a preset that define the drawing order of particles. These members require the composition
/// "sorted". The other compositions sum media, and a sum does not depend on the order.
#pragma once

#include "simulation/solver/effect_def.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace fx::preset {

struct OrderMember
{
    std::string pointer; ///< JSON pointer in the preset
    std::string text;    ///< text of the member, without spaces
};

/// Lists the members "order" with the value "oldest" or "youngest", and "orderBias" other than 0.
/// @param preset a valid preset
std::vector<OrderMember> orderMembers(const nlohmann::json& preset);

/// Text of the warning about a result of orderMembers(), without a remedy.
std::string orderWarning(const OrderMember& member);

/// Whether `composition` sums media. Then the order of particles has no effect.
inline bool sumsUp(sim::PreferredComposition composition)
{
    return composition > sim::PreferredComposition::Sorted;
}

} // namespace fx::preset
