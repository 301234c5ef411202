#include "fxsdk/presets/still_medium.h"

#include "fxsdk/presets/layer_names.h"

#include <array>
#include <span>
#include <utility>

namespace fx::preset {

void readStillMedium(const PresetValue& element, sim::StillMediumDef& out)
{
    element.read("name", out.name);
    element.read("position", out.position);
    element.read("scale", out.scale);
    element.read("density", out.density);
    element.read("anisotropy", out.anisotropy);
    element.read("fireShare", out.fireShare);
    element.read("layer", std::span<const std::pair<std::string_view, base::MediaLayer>>(kLayerNames),
                 out.layer);
}

void readSequenceEnd(const PresetValue& element, sim::SequenceEnd& out)
{
    static constexpr std::array<std::pair<std::string_view, sim::SequenceEnd>, 2> kEnds{
        {{"hold", sim::SequenceEnd::Hold}, {"loop", sim::SequenceEnd::Loop}}};
    element.read("end", std::span<const std::pair<std::string_view, sim::SequenceEnd>>(kEnds), out);
}

} // namespace fx::preset
