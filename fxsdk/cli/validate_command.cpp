/// @file validate_command.cpp
/// fx validate: presets and scenes against their schema.

#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/exit_code.h"
#include "fxsdk/cli/interrupt.h"
#include "fxsdk/cli/json_line.h"
#include "fxsdk/scene_file/validate_file.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

struct ValidateOptions
{
    std::vector<std::string> files;
    bool json = false;
};

nlohmann::json toJson(const preset::Diagnostic& diagnostic)
{
    return {{"line", diagnostic.line},
            {"column", diagnostic.column},
            {"pointer", diagnostic.pointer},
            {"message", diagnostic.message},
            {"severity", diagnostic.warning ? "warning" : "error"}};
}

void printJson(const std::string& file, const std::vector<preset::Diagnostic>& diagnostics, uint64_t bytes,
               const Machine& machine)
{
    nlohmann::json findings = nlohmann::json::array();
    for (const preset::Diagnostic& diagnostic : diagnostics)
        findings.push_back(toJson(diagnostic));
    const bool valid = !preset::hasErrors(diagnostics);
    nlohmann::json report = {{"file", file}, {"valid", valid}, {"diagnostics", findings}};
    if (bytes > 0)
        report["bytes_instance"] = bytes;
    printJsonLine(withMachine(report, machine));
}

int runValidate(const ValidateOptions& options)
{
    const Machine machine = options.json ? readMachine() : Machine{};
    size_t invalid = 0;
    for (const std::string& file : options.files) {
        if (interruptRequested())
            return kInterrupted;
        uint64_t bytes = 0;
        const std::vector<preset::Diagnostic> diagnostics = preset::validateFile(file, &bytes);
        invalid += preset::hasErrors(diagnostics) ? 1 : 0;
        if (options.json) {
            printJson(file, diagnostics, bytes, machine);
            continue;
        }
        for (const preset::Diagnostic& diagnostic : diagnostics)
            std::printf("%s%s\n", diagnostic.warning ? "warning: " : "",
                        preset::toString(diagnostic).c_str());
        if (bytes > 0 && options.files.size() == 1)
            std::printf("about %.1f MiB of memory for each instance\n", double(bytes) / (1 << 20));
    }
    if (!options.json && invalid == 0)
        std::printf("%zu %s valid\n", options.files.size(),
                    options.files.size() == 1 ? "file is" : "files are");
    return invalid == 0 ? kSuccess : kFailed;
}

} // namespace

void addValidateCommand(CLI::App& app, int& outExitCode)
{
    auto options = std::make_shared<ValidateOptions>();
    CLI::App* command = app.add_subcommand("validate", "Check presets (*.fx.json) and scenes (*.scene.json)");
    command
        ->add_option("FILE", options->files,
                     "What to check; every finding is printed as file:line:column: pointer: "
                     "message")
        ->required();
    command->add_flag("--json", options->json, "One object per file: file, valid, diagnostics");
    command->callback([options, &outExitCode] { outExitCode = runValidate(*options); });
}

} // namespace fx::cli
