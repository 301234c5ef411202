#include "fxsdk/editor/panels/panels.h"

#include <cstdlib>
#include <filesystem>

namespace fx::editor {

namespace {

using Json = nlohmann::json;

constexpr double kAnswerSeconds = 0.25; ///< that each game has when somebody looks for games

std::string tokenOfEnvironment()
{
    const char* const token = std::getenv("FXSDK_LINK_TOKEN");
    return token ? token : "";
}

/// By which the game finds its preset: the whole path of a file.
std::string presetName(const Session& session)
{
    if (session.name().starts_with("library:"))
        return session.name();
    std::error_code error;
    const std::filesystem::path path = std::filesystem::absolute(session.name(), error);
    return error ? session.name() : path.lexically_normal().string();
}

void lookForGames(PanelState& state)
{
    GameLink& link = state.link;
    link.games.clear();
    link.hasLooked = true;
    for (link::Game& game : link::findGames()) {
        FoundGame found{std::move(game), {}, {}};
        const bool isOurs = link.edit.state() == link::LinkState::Connected &&
                            link.edit.address().path == found.game.address.path;
        const base::Result<Json> list =
            isOurs ? base::Result<Json>(link.edit.list())
                   : link::askForList(found.game.address, tokenOfEnvironment(), kAnswerSeconds);
        if (list)
            found.list = *list;
        else
            found.failure = list.status().message();
        link.games.push_back(std::move(found));
    }
}

/// Presets and numbers of instances, a line each.
void presetLines(const Json& list)
{
    if (!list.is_object())
        return;
    for (const Json& preset : list.value("presets", Json::array()))
        ImGui::BulletText("%s \"%s\": %llu instances", preset.value("source", "").c_str(),
                          preset.value("name", "").c_str(),
                          static_cast<unsigned long long>(preset.value("instances", uint64_t(0))));
    size_t shown = 0;
    constexpr size_t kShown = 20;
    for (const Json& instance : list.value("instances", Json::array())) {
        if (++shown > kShown)
            break;
        ImGui::TextDisabled("   %s at %.2f s, %llu particles", instance.value("state", "").c_str(),
                            instance.value("seconds", 0.0),
                            static_cast<unsigned long long>(instance.value("particles", uint64_t(0))));
    }
    const uint64_t count = list.value("instanceCount", uint64_t(0));
    if (count > kShown)
        ImGui::TextDisabled("   and %llu more", static_cast<unsigned long long>(count - kShown));
}

void connectedGame(PanelState& state)
{
    link::LiveEdit& edit = state.link.edit;
    if (button(state, "Disconnect", "games/disconnect")) {
        edit.stop();
        return;
    }
    ImGui::SameLine();
    ImGui::PushTextWrapPos(0.0f);
    const bool isFine = edit.message().empty() && (edit.outcome().revision == 0 || edit.outcome().isShown);
    ImGui::TextColored(isFine ? ImVec4(0.62f, 0.85f, 0.60f, 1.0f) : ImVec4(1.0f, 0.55f, 0.45f, 1.0f), "%s",
                       linkText(state).c_str());
    ImGui::PopTextWrapPos();
    ImGui::TextDisabled("%s", link::toString(edit.address()).c_str());
    presetLines(edit.list());
}

} // namespace

void startLink(PanelState& state, const link::Address& address)
{
    state.link.edit.start(address, tokenOfEnvironment(), presetName(state.session));
}

std::string linkText(const PanelState& state)
{
    const link::LiveEdit& edit = state.link.edit;
    const link::Outcome& outcome = edit.outcome();
    if (edit.state() == link::LinkState::Off)
        return "no game is linked";
    if (edit.state() == link::LinkState::Connecting)
        return edit.message().empty() ? "connecting" : "no connection, trying again: " + edit.message();
    if (outcome.revision == 0)
        return edit.game() + ": connected";
    if (!outcome.isShown)
        return edit.game() + " does not show the edit: " + outcome.message;
    return edit.game() + ": shown by " + std::to_string(outcome.instances) +
           (outcome.instances == 1 ? " instance" : " instances") + " after " +
           std::to_string(outcome.frames) + (outcome.frames == 1 ? " frame" : " frames");
}

void gamesPanel(PanelState& state)
{
    GameLink& link = state.link;
    if (state.session.document.kind() != DocumentKind::Preset) {
        ImGui::TextDisabled("A running game shows presets, no scenes.");
        return;
    }
    if (link.edit.state() != link::LinkState::Off)
        connectedGame(state);
    if (button(state, "Look for games", "games/look"))
        lookForGames(state);
    if (link.hasLooked && link.games.empty())
        ImGui::TextDisabled("No running game has a live link in %s.", link::linkFolder().c_str());
    for (size_t i = 0; i < link.games.size(); ++i) {
        const FoundGame& found = link.games[i];
        ImGui::PushID(int(i));
        const std::string name = found.game.name + "-" + std::to_string(found.game.pid);
        if (button(state, "Connect", "games/connect/" + found.game.name))
            startLink(state, found.game.address);
        ImGui::SameLine();
        ImGui::TextUnformatted(name.c_str());
        if (!found.failure.empty())
            ImGui::TextDisabled("   %s", found.failure.c_str());
        presetLines(found.list);
        ImGui::PopID();
    }
}

} // namespace fx::editor
