/// @file parameters_command.cpp
/// fx parameters: what presets can say, generated from the schema that validates them.

#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/exit_code.h"
#include "fxsdk/presets/parameter_reference.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace fx::cli {

namespace {

/// The parts of the reference whose heading contains `name`; all of it for an empty one.
std::string sectionsOf(const std::string& reference, const std::string& name)
{
    if (name.empty())
        return reference;
    constexpr std::string_view kHeading = "\n## ";
    std::string text;
    for (size_t at = reference.find(kHeading); at != std::string::npos;) {
        const size_t next = reference.find("\n#", at + kHeading.size());
        const std::string part = reference.substr(at, next == std::string::npos ? next : next - at);
        if (part.substr(0, part.find('\n', 1)).find(name) != std::string::npos)
            text += part;
        at = reference.find(kHeading, at + 1);
    }
    return text;
}

} // namespace

void addParametersCommand(CLI::App& app, int& outExitCode)
{
    CLI::App* command = app.add_subcommand(
        "parameters", "Print the parameter reference: unit, range, default and cost (Markdown)");
    auto section = std::make_shared<std::string>();
    auto schema = std::make_shared<std::string>();
    CLI::Option* asSchema =
        command
            ->add_option("--json-schema", *schema, "The JSON Schema of preset or scene, for editors, instead")
            ->check(CLI::IsMember({"preset", "scene"}));
    command->add_option("SECTION", *section, "Only headings that contain this, such as emitters[]/forces")
        ->excludes(asSchema);
    command->callback([section, schema, &outExitCode] {
        const std::string text = *schema == "preset"  ? preset::presetSchemaText()
                                 : *schema == "scene" ? preset::sceneSchemaText()
                                                      : sectionsOf(preset::parameterReference(), *section);
        std::fputs(text.c_str(), stdout);
        outExitCode = text.empty() ? kFailed : kSuccess;
        if (text.empty())
            std::fprintf(stderr, "fx parameters: no heading contains \"%s\"; \"fx parameters\" prints all\n",
                         section->c_str());
    });
}

} // namespace fx::cli
