#include "fxsdk/editor/session/overlays.h"

#include <cstdio>

namespace fx::editor {

std::string overlayText(const OverlayChoice& choice, const OverlayData& data)
{
    std::string text;
    const auto add = [&](const char* format, auto... values) {
        char part[96];
        std::snprintf(part, sizeof part, format, values...);
        text += (text.empty() ? "" : "   ") + std::string(part);
    };
    if (choice.bounds)
        add("%u bounds", data.bounded);
    if (choice.velocities)
        add("%u of %u velocities", data.arrows, data.moving);
    if (choice.overdraw)
        add("overdraw: mean %.1f, largest %.0f", data.overdraw.mean, data.overdraw.largest);
    if (choice.slice)
        add("slice: mean %.1f balls, largest %.0f", data.slice.mean, data.slice.largest);
    if (choice.lightSlices)
        add(data.volumes > 0 ? "%u volumes of light slices" : "no light slices: no medium casts a shadow",
            data.volumes);
    return text;
}

} // namespace fx::editor
