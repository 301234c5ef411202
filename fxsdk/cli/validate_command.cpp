/// @file validate_command.cpp
/// fx validate: presets and scenes against their schema.

#include "foundation/tasks/work_budget.h"
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

/// [ms] of one core, about, that so many work units take.
double millisecondsOf(double units)
{
    return units * base::kSecondsPerUnit * 1e3;
}

void printNeeds(const preset::Needs& needs)
{
    std::printf("about %.1f MiB of memory for each instance, %.1f MiB with what is shown of it\n",
                double(needs.solverBytes) / (1 << 20), double(needs.cost.memory) / (1 << 20));
    std::printf("about %.3g ms of a core for its most expensive step", millisecondsOf(needs.cost.stepWork));
    if (needs.cost.startWork > 0)
        std::printf(", %.3g ms for its prewarm", millisecondsOf(needs.cost.startWork));
    std::printf("\n");
}

void printJson(const std::string& file, const std::vector<preset::Diagnostic>& diagnostics,
               const preset::Needs& needs, const Machine& machine)
{
    nlohmann::json findings = nlohmann::json::array();
    for (const preset::Diagnostic& diagnostic : diagnostics)
        findings.push_back(toJson(diagnostic));
    const bool valid = !preset::hasErrors(diagnostics);
    nlohmann::json report = {{"file", file}, {"valid", valid}, {"diagnostics", findings}};
    if (needs.solverBytes > 0) {
        report["bytes_instance"] = needs.solverBytes;
        report["bytes_instance_shown"] = needs.cost.memory;
        report["work_step"] = needs.cost.stepWork;
        report["ms_step"] = millisecondsOf(needs.cost.stepWork);
        report["work_prewarm"] = needs.cost.startWork;
        report["ms_prewarm"] = millisecondsOf(needs.cost.startWork);
    }
    printJsonLine(withMachine(report, machine));
}

int runValidate(const ValidateOptions& options)
{
    const Machine machine = options.json ? readMachine() : Machine{};
    size_t invalid = 0;
    for (const std::string& file : options.files) {
        if (interruptRequested())
            return kInterrupted;
        preset::Needs needs;
        const std::vector<preset::Diagnostic> diagnostics = preset::validateFile(file, &needs);
        invalid += preset::hasErrors(diagnostics) ? 1 : 0;
        if (options.json) {
            printJson(file, diagnostics, needs, machine);
            continue;
        }
        for (const preset::Diagnostic& diagnostic : diagnostics)
            std::printf("%s%s\n", diagnostic.warning ? "warning: " : "",
                        preset::toString(diagnostic).c_str());
        if (needs.solverBytes > 0 && options.files.size() == 1)
            printNeeds(needs);
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
