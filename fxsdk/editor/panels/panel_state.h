/// @file panel_state.h
/// What panels share in a frame: the session, the places of widgets, and what is being typed or dragged.
#pragma once

#include "fxsdk/editor/document/text_difference.h"
#include "fxsdk/editor/panels/curve_selection.h"
#include "fxsdk/editor/panels/imgui_version.h"
#include "fxsdk/editor/session/budget_report.h"
#include "fxsdk/editor/session/render_request.h"
#include "fxsdk/editor/session/session.h"
#include "fxsdk/livelink/client/live_edit.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace fx::editor {

/// What the host of the panels tells them about the picture.
struct PictureState
{
    uint32_t texture = 0;                     ///< GL name; 0: no picture
    uint32_t particles = 0;                   ///< alive
    std::map<std::string, uint32_t> elements; ///< particles alive by the pointer of their element
    double milliseconds = 0.0;                ///< [ms] of the last picture: seek and drawing
    float exposureEv100 = 0.0f;               ///< [EV100] of the scene
    std::string failure;                      ///< why the picture does not show the document; empty: it does
    EffectPlacement placement;                ///< of the effect of a preset
    OverlayData overlays;
    uint32_t beforeTexture = 0; ///< GL name of the picture of before; 0: none
    std::string beforeFailure;  ///< why there is no picture of before; empty: there is one
};

/// What the host tells of the comparison with the reference renderer.
struct ErrorState
{
    bool isAsked = false;   ///< the host shall begin
    bool isStopped = false; ///< the host shall cancel
    bool isRunning = false;
    double progress = 0.0; ///< [0, 1]
    uint32_t texture = 0;  ///< GL name of the error as a picture, upper row first; 0: none
    bool isShown = false;  ///< over the picture
    std::string text;      ///< mean, p99 and largest error, or the cause of a failure
};

/// What the host tells of the measured budget.
struct BudgetState
{
    bool isAsked = false;   ///< the host shall begin
    bool isStopped = false; ///< the host shall stop
    bool isRunning = false;
    bool isOld = true;     ///< the document has changed since
    double progress = 0.0; ///< [0, 1]
    BudgetReport report;
    std::string failure; ///< empty: none
};

/// What the host tells of the pictures that it writes.
struct RenderState
{
    RenderRequest request;
    bool isAsked = false;   ///< the host shall begin
    bool isStopped = false; ///< the host shall cancel
    bool isRunning = false;
    double progress = 0.0; ///< [0, 1]
};

/// A rectangle on the screen [pixel].
struct Place
{
    ImVec2 low;
    ImVec2 high;
    bool isVisible = true; ///< false: its middle is scrolled out of its panel

    ImVec2 middle() const { return {0.5f * (low.x + high.x), 0.5f * (low.y + high.y)}; }
};

/// The difference from the saved file, which is found again when one of the texts has changed.
struct ShownDifference
{
    std::string before;
    std::string after;
    std::vector<DifferenceLine> lines;
};

/// A running game that was found, and what it says.
struct FoundGame
{
    link::Game game;
    nlohmann::json list; ///< presets and instances; null: see `failure`
    std::string failure; ///< why there is no list
};

/// The link to a running game, and the games that were found when somebody asked.
struct GameLink
{
    link::LiveEdit edit;
    std::vector<FoundGame> games;
    bool hasLooked = false;
};

struct PanelState
{
    explicit PanelState(Session& shown) : session(shown) {}

    Session& session;
    PictureState picture;
    ErrorState error;
    BudgetState budget;
    RenderState render;
    /// Places of the widgets of this frame by name, for scripts and tests.
    std::map<std::string, Place> places;
    std::vector<std::string> closedHeaders; ///< pointers of the headers of this frame that are closed
    std::string opened;                     ///< name whose headers are opened in this frame; empty: none
    std::string scrolledTo;                 ///< name of a widget that its panel scrolls to; empty: none
    ImVec2 pictureSize{640.0f, 360.0f};     ///< [pixel] wanted for the next picture

    std::string heldHandle;                ///< name of the handle that is dragged; empty: none
    std::string heldMark;                  ///< name of the mark of the timeline that is dragged; empty: none
    std::string triggered;                 ///< pointer of the instance that the choice of triggers belongs to
    std::vector<std::string> triggerNames; ///< events that it listens to
    ImVec2 heldOffset;                     ///< [pixel] from the mouse to the handle
    ImGuiID typedField = 0;                ///< field that is being typed into
    std::string typed;                     ///< its text
    uint64_t gesture = 0;                  ///< number of the last drag
    std::vector<SelectedKey> keys;         ///< selected keys of the curves
    std::vector<SelectedKey> keysBefore;   ///< the same when the drag began
    std::set<std::string> shownCurves;     ///< names of members whose curves are shown beside the clicked one
    std::vector<ShownCurve> draggedCurves; ///< curves when the drag began
    std::optional<SelectedKey> grabbedKey; ///< key under the mouse when the drag began; empty: none
    ImVec2 draggedFrom;                    ///< [pixel] where the drag began
    /// Lower and upper end of the scale of each curve.
    std::map<std::string, std::pair<double, double>> curveScales;
    std::string search; ///< text of the search over members
    std::string saveAs; ///< name in the dialog "save as"
    bool wantsClose = false;
    bool asksCamera = false; ///< the host shall look through the camera of the document
    bool asksWhy = false;    ///< the host shall answer "why is nothing visible"
    std::string why;         ///< the answer
    ShownDifference difference;
    GameLink link;

    /// Keeps the place of the last widget under a name.
    void mark(const std::string& name)
    {
        Place place{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
        const ImVec2 middle = place.middle();
        place.isVisible = ImGui::IsRectVisible(middle, {middle.x + 1.0f, middle.y + 1.0f});
        places[name] = place;
        if (name == scrolledTo)
            ImGui::SetScrollHereY();
    }

    /// Opens the next header or tree node if the widget that a script opens lies in it.
    void openIfAsked(const std::string& pointer) const
    {
        const size_t at = opened.find(pointer);
        const size_t end = at + pointer.size();
        if (at != std::string::npos && opened.find('/') == at && (end == opened.size() || opened[end] == '/'))
            ImGui::SetNextItemOpen(true);
    }

    /// Number of the drag of the last widget: the same while it is active.
    uint64_t dragOf()
    {
        if (ImGui::IsItemActivated())
            ++gesture;
        return gesture;
    }
};

} // namespace fx::editor
