/// @file curve_view.h
/// What the parts of the curve panel share: the curves that are shown, the clicked one first.
#pragma once

#include "fxsdk/editor/inspector/member.h"
#include "fxsdk/editor/panels/curve_selection.h"
#include "fxsdk/editor/panels/panel_state.h"

#include <vector>

namespace fx::editor {

struct CurveView
{
    Member member;
    ShownCurve curve;
    ImU32 color = 0;
};

/// Writes changed curves as one edit. @param gesture 0: none
void commitCurves(PanelState& state, const std::vector<ShownCurve>& curves, uint64_t gesture);

/// The curves of views.
std::vector<ShownCurve> curvesOf(const std::vector<CurveView>& views);

/// Buttons of curves to begin with, for the first curve.
void curvePresets(PanelState& state, const std::vector<CurveView>& views);

/// Buttons that show and hide other curves of the same object. @param names of its curves of numbers
void curveChoices(PanelState& state, const std::vector<CurveView>& views, const std::vector<Member>& all);

/// Numbers of the selected keys.
void curveFields(PanelState& state, const std::vector<CurveView>& views);

/// Color of a curve by its place among the curves of its object.
ImU32 curveColor(size_t place);

} // namespace fx::editor
