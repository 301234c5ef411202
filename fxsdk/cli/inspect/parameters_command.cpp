/// @file parameters_command.cpp
/// fx parameters: what presets can say, generated from the schema that validates them.

#include "foundation/result/nearest_name.h"
#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/inspect/search_text.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/named_choice.h"
#include "fxsdk/presets/parameter_reference.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace fx::cli {

namespace {

/// What the lines of a section are, in this order: its heading, its description, and a table.
struct Section
{
    std::string text;                  ///< all of it
    std::string heading;               ///< with the line break
    std::string tableHead;             ///< two lines
    std::vector<std::string> rows;     ///< one a member, with the line break
    std::vector<std::string> members;  ///< name of each row
    std::vector<std::string> meanings; ///< description of each row
};

/// `line` as a row of the table: | `name` | description | ...
void addRow(const std::string& line, Section& io)
{
    const size_t nameEnd = line.find("` | ");
    const size_t meaningEnd = nameEnd == std::string::npos ? nameEnd : line.find(" | ", nameEnd + 4);
    if (meaningEnd == std::string::npos)
        return;
    io.rows.push_back(line + "\n");
    io.members.push_back(line.substr(3, nameEnd - 3));
    io.meanings.push_back(line.substr(nameEnd + 4, meaningEnd - nameEnd - 4));
}

std::vector<Section> sectionsOf(const std::string& reference)
{
    std::vector<Section> sections;
    std::istringstream lines(reference);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("## "))
            sections.push_back({{}, line + "\n", {}, {}, {}, {}});
        if (sections.empty() || line.starts_with("# "))
            continue;
        sections.back().text += line + "\n";
        if (line.starts_with("| `"))
            addRow(line, sections.back());
        else if (line.starts_with("|"))
            sections.back().tableHead += line + "\n";
    }
    return sections;
}

/// Sections whose heading contains `word`, and of the others the members that contain it in their name or in
/// their description; letter case does not matter.
std::string matches(const std::vector<Section>& sections, const std::string& word)
{
    std::string text;
    for (const Section& section : sections) {
        if (containsIgnoringCase(section.heading, word)) {
            text += "\n" + section.text;
            continue;
        }
        std::string rows;
        for (size_t i = 0; i < section.rows.size(); ++i)
            if (containsIgnoringCase(section.members[i], word) ||
                containsIgnoringCase(section.meanings[i], word))
                rows += section.rows[i];
        if (!rows.empty())
            text += "\n" + section.heading + "\n" + section.tableHead + rows;
    }
    return text;
}

int printMatches(const std::string& word)
{
    const std::string reference = preset::parameterReference();
    if (word.empty()) {
        std::fputs(reference.c_str(), stdout);
        return kSuccess;
    }
    const std::vector<Section> sections = sectionsOf(reference);
    const std::string found = matches(sections, word);
    std::fputs(found.c_str(), stdout);
    if (!found.empty())
        return kSuccess;
    std::vector<std::string> members;
    for (const Section& section : sections)
        members.insert(members.end(), section.members.begin(), section.members.end());
    std::fprintf(
        stderr,
        "fx parameters: no heading, member or description contains \"%s\"%s; \"fx parameters\" prints all\n",
        word.c_str(), base::didYouMean(word, members).c_str());
    return kFailed;
}

} // namespace

void addParametersCommand(CLI::App& app, int& outExitCode)
{
    CLI::App* command = app.add_subcommand(
        "parameters", "Print the parameter reference: unit, range, default and cost (Markdown)");
    auto word = std::make_shared<std::string>();
    auto schema = std::make_shared<std::string>();
    CLI::Option* asSchema =
        command
            ->add_option("--json-schema", *schema, "The JSON Schema of preset or scene, for editors, instead")
            ->check(oneOf({"preset", "scene"}));
    command
        ->add_option(
            "WORD", *word,
            "Only sections whose heading contains it, such as emitters[]/forces, and members that contain "
            "it in their name or description")
        ->excludes(asSchema);
    command->callback([word, schema, &outExitCode] {
        if (schema->empty()) {
            outExitCode = printMatches(*word);
            return;
        }
        const std::string text = *schema == "preset" ? preset::presetSchemaText() : preset::sceneSchemaText();
        std::fputs(text.c_str(), stdout);
        outExitCode = kSuccess;
    });
}

} // namespace fx::cli
