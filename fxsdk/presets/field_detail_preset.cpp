#include "fxsdk/presets/field_detail_preset.h"

#include <array>
#include <span>
#include <string_view>
#include <utility>

namespace fx::preset {

namespace {

using MaterialName = std::pair<std::string_view, sim::DetailMaterial>;
constexpr std::array<MaterialName, 4> kMaterials{{{"fireball", sim::DetailMaterial::Fireball},
                                                  {"smoke", sim::DetailMaterial::Smoke},
                                                  {"steam", sim::DetailMaterial::Steam},
                                                  {"dust", sim::DetailMaterial::Dust}}};
constexpr float kFarAway = 0.5f; // [1] billow size below which a medium looks like one farther away
constexpr float kBoiling = 2.0f; // [1] liveliness above which renewals are seen

} // namespace

void readFieldDetail(const PresetValue& element, sim::FieldDetail& out)
{
    if (!element.has("detail"))
        return;
    const PresetValue detail = element.child("detail");
    out.given = true;
    detail.read("material", std::span<const MaterialName>(kMaterials), out.material);
    detail.read("billowSize", out.billowSize);
    detail.read("crispness", out.crispness);
    detail.read("raggedness", out.raggedness);
    detail.read("softening", out.softening);
    detail.read("liveliness", out.liveliness);
    if (out.billowSize < kFarAway)
        detail.warning("billowSize",
                       "billows much smaller than balls make the medium look farther away and small; "
                       "more and smaller balls show more detail");
    if (out.liveliness > kBoiling)
        detail.warning("liveliness", "the pattern is renewed so soon that the medium seems to boil");
}

} // namespace fx::preset
