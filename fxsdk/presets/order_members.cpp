#include "fxsdk/presets/order_members.h"

#include <nlohmann/json.hpp>

namespace fx::preset {

namespace {

using Json = nlohmann::json;

void collect(const Json& value, const std::string& pointer, std::vector<OrderMember>& out)
{
    if (!value.is_structured())
        return;
    for (const auto& [key, member] : value.items()) {
        const std::string at = pointer + "/" + key;
        const bool isByAge = key == "order" && (member == "oldest" || member == "youngest");
        const bool isBiased = key == "orderBias" && member.is_number() && member != 0;
        if (isByAge || isBiased)
            out.push_back({at, "\"" + key + "\": " + member.dump()});
        collect(member, at, out);
    }
}

} // namespace

std::vector<OrderMember> orderMembers(const Json& preset)
{
    std::vector<OrderMember> found;
    if (preset.is_object())
        collect(preset.value("emitters", Json::array()), "/emitters", found);
    return found;
}

std::string orderWarning(const OrderMember& member)
{
    return "found " + member.text +
           ", which needs the composition \"sorted\": others sum particles up without an order";
}

} // namespace fx::preset
