/// @file list_command.cpp
/// fx list: the presets of the built-in library.

#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/inspect/search_text.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/presets/preset_loader.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace fx::cli {

namespace {

struct ListOptions
{
    std::string word;
    bool json = false;
};

struct ListEntry
{
    std::string name; ///< without "library:"
    std::string description;
};

std::vector<ListEntry> presetsWith(const std::string& word)
{
    constexpr std::string_view kEnd = ".fx.json";
    std::vector<ListEntry> entries;
    for (const base::EmbeddedText& file : preset::presetLibrary()) {
        const nlohmann::json preset = nlohmann::json::parse(file.text);
        ListEntry entry{std::string(file.name.substr(0, file.name.size() - kEnd.size())),
                        preset.value("description", std::string())};
        if (containsIgnoringCase(entry.name, word) || containsIgnoringCase(entry.description, word))
            entries.push_back(std::move(entry));
    }
    return entries;
}

/// The first clause of a description.
std::string beginOf(const std::string& description)
{
    return description.substr(0, std::min(description.find(": "), description.find(". ")));
}

int printList(const ListOptions& options)
{
    const std::vector<ListEntry> entries = presetsWith(options.word);
    if (entries.empty()) {
        std::fprintf(stderr,
                     "fx list: no preset has \"%s\" in its name or description; \"fx list\" prints all\n",
                     options.word.c_str());
        return kFailed;
    }
    if (options.json) {
        const Machine machine = readMachine();
        for (const ListEntry& entry : entries)
            printJsonLine(withMachine({{"name", entry.name}, {"description", entry.description}}, machine));
        return kSuccess;
    }
    size_t width = 0;
    for (const ListEntry& entry : entries)
        width = std::max(width, entry.name.size());
    for (const ListEntry& entry : entries)
        std::printf("%-*s  %s\n", int(width), entry.name.c_str(), beginOf(entry.description).c_str());
    return kSuccess;
}

} // namespace

void addListCommand(CLI::App& app, int& outExitCode)
{
    CLI::App* command =
        app.add_subcommand("list", "List the presets of the library, which library:NAME names");
    auto options = std::make_shared<ListOptions>();
    command->add_option("WORD", options->word, "Only presets that have it in their name or description");
    command->add_flag("--json", options->json, "One object a preset");
    command->callback([options, &outExitCode] { outExitCode = printList(*options); });
}

} // namespace fx::cli
