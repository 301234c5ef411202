#include "fxsdk/editor/panels/panels.h"

#include <algorithm>
#include <cmath>

namespace fx::editor {

namespace {

constexpr double kHottest = 32.0; // layers of the brightest color of the overdraw

ImU32 colorOf(WireKind kind)
{
    switch (kind) {
    case WireKind::Bounds:
        return IM_COL32(120, 230, 140, 200);
    case WireKind::Velocity:
        return IM_COL32(90, 210, 255, 220);
    case WireKind::LightSlices:
        return IM_COL32(255, 220, 90, 200);
    }
    return IM_COL32_WHITE;
}

/// Blue, green, yellow, red for 1, 3, 10 and 32 particles over each other.
ImU32 heat(float count)
{
    const float t = std::clamp(float(std::log(double(count) + 1.0) / std::log(kHottest + 1.0)), 0.0f, 1.0f);
    const float r = std::clamp(3.0f * t - 1.2f, 0.0f, 1.0f),
                g = std::clamp(1.6f - std::abs(4.0f * t - 2.2f), 0.0f, 1.0f);
    const float b = std::clamp(1.4f - 3.0f * t, 0.0f, 1.0f);
    return IM_COL32(int(255 * r), int(255 * g), int(255 * b), 175);
}

void overdraw(ImDrawList* draw, const OverdrawMap& map, ImVec2 low, ImVec2 high)
{
    if (map.columns == 0 || map.rows == 0)
        return;
    const float width = (high.x - low.x) / float(map.columns), height = (high.y - low.y) / float(map.rows);
    for (int row = 0; row < map.rows; ++row)
        for (int column = 0; column < map.columns;) { // a run of equal colors is one rectangle
            const auto colorAt = [&](int c) {
                const float count = map.counts[size_t(row) * size_t(map.columns) + size_t(c)];
                return count < 0.05f ? 0u : heat(count < 4.0f ? count : std::round(count));
            };
            const ImU32 color = colorAt(column);
            int end = column + 1;
            while (end < map.columns && colorAt(end) == color)
                ++end;
            if (color != 0)
                draw->AddRectFilled({low.x + width * float(column), low.y + height * float(row)},
                                    {low.x + width * float(end), low.y + height * float(row + 1)}, color);
            column = end;
        }
}

} // namespace

void drawOverlays(PanelState& state, const ViewProjection& view, ImVec2 low, ImVec2 high)
{
    const OverlayChoice& choice = state.session.overlays;
    const OverlayData& data = state.picture.overlays;
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const bool isError = state.error.isShown && state.error.texture != 0;
    if (choice.overdraw && !isError)
        overdraw(draw, data.overdraw, low, high);
    if (choice.slice && !isError)
        overdraw(draw, data.slice, low, high);
    for (const WireLine& line : data.lines) {
        const auto ends = view.project(line.from, line.to);
        if (!ends)
            continue;
        const ImVec2 a(float(ends->first.x), float(ends->first.y)),
            b(float(ends->second.x), float(ends->second.y));
        draw->AddLine(a, b, colorOf(line.kind), line.kind == WireKind::Velocity ? 1.0f : 1.5f);
        if (line.kind == WireKind::Velocity)
            draw->AddCircleFilled(a, 1.6f, colorOf(line.kind));
    }
}

} // namespace fx::editor
