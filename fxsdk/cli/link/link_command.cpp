/// @file link_command.cpp
/// fx link: lists running games that have a live link, and sends them edited presets.

#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/assets/read_file.h"
#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/livelink/client/link_client.h"
#include "fxsdk/presets/preset_loader.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

struct LinkOptions
{
    std::string address;
    std::string token;
    std::string preset;
    std::string name;
    double timeout = 10.0; ///< [s]
    int measuredEdits = 0;
    bool restarts = false;
    bool isJson = false;
};

std::string tokenOf(const LinkOptions& options)
{
    const char* const variable = std::getenv("FXSDK_LINK_TOKEN"); // command lines are visible to others
    return !options.token.empty() ? options.token : variable ? variable : "";
}

int report(const base::Status& status)
{
    if (!status)
        std::fprintf(stderr, "fx link: %s\n", status.message().c_str());
    return exitCodeOf(status);
}

// ---- list ----

void printGame(const std::string& title, const base::Result<Json>& list)
{
    std::printf("%s\n", title.c_str());
    if (!list) {
        std::printf("  %s\n", list.status().message().c_str());
        return;
    }
    for (const Json& preset : list->value("presets", Json::array()))
        std::printf("  %s \"%s\": %llu instances\n", preset.value("source", "").c_str(),
                    preset.value("name", "").c_str(),
                    static_cast<unsigned long long>(preset.value("instances", uint64_t(0))));
    std::printf("  %llu instances in all\n",
                static_cast<unsigned long long>(list->value("instanceCount", uint64_t(0))));
}

void printGameAsJson(const std::string& address, const base::Result<Json>& list)
{
    Json line = list ? *list : Json{{"error", list.status().message()}};
    line.erase("type");
    line.erase("id");
    line["address"] = address;
    printJsonLine(line);
}

int runList(const LinkOptions& options)
{
    std::vector<std::pair<std::string, link::Address>> games;
    if (!options.address.empty()) {
        const base::Result<link::Address> address = link::parseAddress(options.address);
        if (!address)
            return report(address.status());
        games.push_back({"", *address});
    } else {
        for (const link::Game& game : link::findGames())
            games.push_back({game.name + "-" + std::to_string(game.pid) + " ", game.address});
        if (games.empty() && !options.isJson)
            std::printf("no running game has a live link in %s\n", link::linkFolder().c_str());
    }
    bool hasFailed = false;
    for (const auto& [title, address] : games) {
        const base::Result<Json> list = link::askForList(address, tokenOf(options), options.timeout);
        hasFailed = hasFailed || (!list && !options.address.empty());
        if (options.isJson)
            printGameAsJson(link::toString(address), list);
        else
            printGame(title + link::toString(address), list);
    }
    return hasFailed ? kFailed : kSuccess;
}

// ---- send ----

base::Result<std::string> textOf(const std::string& preset)
{
    if (preset.starts_with("library:"))
        return asset::AssetResolver("", preset::libraryFiles()).read(preset, preset::kPresetBytes);
    return asset::readFile(preset, preset::kPresetBytes);
}

base::Status statusOf(const Json& reply)
{
    if (reply["type"] == "replaced")
        return {};
    return {base::Code::InvalidArgument, "the game refuses the preset: " + reply.value("message", "")};
}

template <class T>
T at(std::vector<T> sorted, double share)
{
    std::sort(sorted.begin(), sorted.end());
    return sorted[std::min(sorted.size() - 1, size_t(double(sorted.size()) * share))];
}

/// Replaces the preset by the text. @return the reply of the game, after a frame has shown it
base::Result<Json> replace(link::LinkClient& client, const LinkOptions& options, uint64_t number,
                           const std::string& text)
{
    if (base::Status status = client.send(link::replaceMessage(number, options.name, text, options.restarts));
        !status)
        return status;
    base::Result<Json> reply = client.wait(options.timeout);
    if (!reply)
        return reply.status();
    if (base::Status status = statusOf(*reply); !status)
        return status;
    return reply;
}

/// Sends the text again and again, each time with other blanks at its end.
base::Status measure(link::LinkClient& client, const LinkOptions& options, const std::string& text)
{
    std::vector<double> milliseconds;
    std::vector<uint64_t> frames;
    for (int i = 0; i < options.measuredEdits; ++i) {
        const Clock::time_point start = Clock::now();
        const std::string edited = text + std::string(size_t(i % 2), '\n');
        const base::Result<Json> reply = replace(client, options, uint64_t(i) + 1, edited);
        if (!reply)
            return reply.status();
        milliseconds.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        frames.push_back(reply->value("frames", uint64_t(0)));
    }
    std::printf(
        "%d edits: median %llu, p95 %llu frames of the game from the message to the frame that shows it; "
        "median %.1f ms, p95 %.1f ms from sending to the reply\n",
        options.measuredEdits, static_cast<unsigned long long>(at(frames, 0.5)),
        static_cast<unsigned long long>(at(frames, 0.95)), at(milliseconds, 0.5), at(milliseconds, 0.95));
    return {};
}

base::Status sendOnce(link::LinkClient& client, const LinkOptions& options, const std::string& text)
{
    const base::Result<Json> reply = replace(client, options, 1, text);
    if (!reply)
        return reply.status();
    std::printf("%s: %s is shown by %llu instances after %llu frames\n", client.game().c_str(),
                reply->value("preset", "").c_str(),
                static_cast<unsigned long long>(reply->value("instances", uint64_t(0))),
                static_cast<unsigned long long>(reply->value("frames", uint64_t(0))));
    return {};
}

base::Status send(LinkOptions options)
{
    const base::Result<std::string> text = textOf(options.preset);
    if (!text)
        return text.status();
    const base::Result<link::Address> address = link::parseAddress(options.address);
    if (!address)
        return address.status();
    if (options.name.empty())
        options.name = options.preset;
    const auto client = link::LinkClient::connect(*address, tokenOf(options));
    if (!client)
        return client.status();
    if (const base::Result<Json> hello = (*client)->waitForHello(options.timeout); !hello)
        return hello.status();
    return options.measuredEdits > 0 ? measure(**client, options, *text) : sendOnce(**client, options, *text);
}

} // namespace

void addLinkCommand(CLI::App& app, int& outExitCode)
{
    auto options = std::make_shared<LinkOptions>();
    CLI::App* command = app.add_subcommand("link", "Change presets of running games that have a live link");
    command->require_subcommand(1);
    const auto addCommon = [&](CLI::App* sub) {
        sub->add_option("--token", options->token, "Token of the game; default: that of FXSDK_LINK_TOKEN");
        sub->add_option("--timeout", options->timeout, "Time that the game has for an answer [s]")
            ->check(CLI::Range(0.01, 3600.0));
    };
    CLI::App* list = command->add_subcommand("list", "Games, their presets and instances");
    list->add_option("--to", options->address, "Only this game: NAME, unix:PATH or tcp:127.0.0.1:PORT");
    list->add_flag("--json", options->isJson, "One JSON object a line");
    addCommon(list);
    list->callback([options, &outExitCode] { outExitCode = runList(*options); });
    CLI::App* send = command->add_subcommand("send", "Show a preset in a game, under its living instances");
    send->add_option("PRESET", options->preset, "*.fx.json or library:NAME")->required();
    send->add_option("--to", options->address, "NAME of the game, unix:PATH or tcp:127.0.0.1:PORT")
        ->required();
    send->add_option("--name", options->name, "Preset of the game; default: the one of the same file");
    send->add_flag("--restart", options->restarts, "Instances start again; default: they keep their time");
    send->add_option("--measure", options->measuredEdits,
                     "Sends the preset so often and prints how long it takes")
        ->check(CLI::Range(1, 100000));
    addCommon(send);
    send->callback([options, &outExitCode] { outExitCode = report(cli::send(*options)); });
}

} // namespace fx::cli
