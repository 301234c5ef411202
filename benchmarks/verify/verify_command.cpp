/// @file verify_command.cpp
/// fx verify: flows with a known course against that course.

#include "benchmarks/measure/calibration.h"
#include "benchmarks/verify/verify_report.h"
#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/cli/support/progress.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <string>

namespace fx::cli {
namespace {

int failed(const base::Status& status)
{
    std::fprintf(stderr, "fx verify: %s\n", status.message().c_str());
    return exitCodeOf(status);
}

base::Result<sim::CaseReport> runPlan(const VerifyPlan& plan, bool showProgress)
{
    const std::unique_ptr<sim::GasCase> gasCase = sim::makeGasCase(*plan.entry, plan.settings);
    const auto tasks = plan.threads == 1 ? base::makeSerialRunner() : base::makeTbbRunner(plan.threads);
    Progress progress(std::string(plan.entry->name), gasCase->sampleTimes().size(), showProgress);
    sim::CaseWatch watch;
    watch.progress = [&progress](uint32_t sample, uint32_t) { progress.update(sample); };
    watch.stop = interruptRequested;
    return plan.doublePrecision ? sim::runCase<double>(*gasCase, *tasks, watch)
                                : sim::runCase<float>(*gasCase, *tasks, watch);
}

int runVerify(const VerifyArguments& arguments)
{
    const base::Result<VerifyPlan> plan = planVerify(arguments);
    if (!plan) {
        failed(plan.status());
        return kUsage;
    }
    if (base::Status status = arguments.csv.empty() ? base::Status() : checkTarget(arguments.csv); !status)
        return failed(status);
    const base::Result<sim::CaseReport> report = runPlan(*plan, !arguments.json);
    if (!report)
        return failed(report.status());
    if (!arguments.csv.empty()) {
        if (base::Status status = writeFileAtomically(arguments.csv, profileCsv(*report)); !status)
            return failed(status);
    }
    if (arguments.json) {
        nlohmann::json json = toJson(*plan, *report);
        json["calibration"] = toJson(calibrate());
        printJsonLine(withMachine(json, readMachine()));
    } else {
        std::printf("%s\n  on %s\n", toText(*plan, *report).c_str(), toText(readMachine()).c_str());
    }
    return arguments.check && !limitsHold(*report) ? kFailed : kSuccess;
}

std::string casesText()
{
    std::string text = "Cases:";
    for (const sim::GasCaseEntry& entry : sim::gasCases())
        text += "\n  " + std::string(entry.name) + std::string(18 - entry.name.size(), ' ') +
                std::string(entry.summary);
    return text;
}

} // namespace

void addVerifyCommand(CLI::App& app, int& outExitCode)
{
    auto arguments = std::make_shared<VerifyArguments>();
    CLI::App* command =
        app.add_subcommand("verify", "Run a gas flow with a known course and print the errors");
    command->add_option("CASE", arguments->caseName, "Name of the case")->required();
    addVerifyOptions(*command, *arguments);
    command->add_option("--csv", arguments->csv,
                        "Write the profile: r[m],rho[kg/m3],v[m/s],p[Pa] of every particle");
    command->add_flag("--check", arguments->check, "Exit code 1 when a limit of the case does not hold");
    command->add_flag("--json", arguments->json, "One object with every number");
    command->footer(casesText());
    command->callback([arguments, &outExitCode] { outExitCode = runVerify(*arguments); });
}

} // namespace fx::cli
