/// @file dazzle_command.cpp
/// fx dazzle: the glare of a saturated sensor on any EXR picture.

#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/dazzle/dazzle_apply.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/cli/support/named_choice.h"
#include "rendering/exr/exr_encoder.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

namespace fx::cli {
namespace {

struct DazzleArguments
{
    std::string input;
    std::string output;
    std::string sensor = "0.01,0,1";
    std::optional<float> white;
    std::string algorithm = "exact";
    bool json = false;
};

int failed(const base::Status& status, int exitCode)
{
    std::fprintf(stderr, "fx dazzle: %s\n", status.message().c_str());
    return exitCode;
}

base::Result<std::string> encode(const DazzleImage& image)
{
    render::ExrImage exr;
    exr.width = image.width;
    exr.height = image.height;
    exr.whiteLuminance = image.whiteLuminance;
    const auto isLight = [](const std::string& name) {
        return name == "R" || name == "G" || name == "B" || name == "Y"; // halves would round the exact sums
    };
    for (const DazzlePlane& plane : image.planes)
        exr.channels.push_back({plane.name, plane.values, 0, 1,
                                plane.isHalf && !isLight(plane.name) ? render::ExrPrecision::Half
                                                                     : render::ExrPrecision::Float});
    return render::encodeExr(exr);
}

void report(const DazzleArguments& arguments, const DazzleImage& image,
            const render::DazzleSettings& settings, const DazzleOutcome& outcome)
{
    for (const std::string& name : image.leftOut)
        std::fprintf(stderr, "fx dazzle: channel %s holds whole numbers and is left out\n", name.c_str());
    if (arguments.json) {
        printJsonLine(withMachine({{"file", arguments.output},
                                   {"width", image.width},
                                   {"height", image.height},
                                   {"algorithm", arguments.algorithm},
                                   {"sensor", {settings.a, settings.b, settings.c}},
                                   {"white", settings.white},
                                   {"overflow", outcome.overflow},
                                   {"replaced", outcome.replaced}},
                                  readMachine()));
        return;
    }
    std::printf("%s: %d x %d, mean overflow %.6g %.6g %.6g of white, %u values replaced\n",
                arguments.output.c_str(), image.width, image.height, outcome.overflow[0], outcome.overflow[1],
                outcome.overflow[2], outcome.replaced);
}

base::Result<render::DazzleSettings> settingsOf(const DazzleArguments& arguments)
{
    render::DazzleSettings settings;
    settings.white = arguments.white.value_or(settings.white);
    if (base::Status status = readSensor(arguments.sensor, settings); !status)
        return status;
    if (arguments.output.size() < 5 || arguments.output.substr(arguments.output.size() - 4) != ".exr")
        return base::Status(base::Code::InvalidArgument, "--output: a name that ends in .exr");
    return settings;
}

int runDazzle(const DazzleArguments& arguments)
{
    const base::Result<render::DazzleSettings> settings = settingsOf(arguments);
    if (!settings)
        return failed(settings.status(), kUsage);
    base::Result<DazzleImage> image = readDazzleImage(arguments.input);
    if (!image)
        return failed(image.status(), kFailed);
    const auto algorithm = arguments.algorithm == "exact" ? DazzleAlgorithm::Exact : DazzleAlgorithm::Paper8;
    const base::Result<DazzleOutcome> outcome = applyDazzle(*image, algorithm, *settings);
    if (!outcome)
        return failed({outcome.status().code(), arguments.input + ": " + outcome.status().message()},
                      kFailed);
    const base::Result<std::string> bytes = encode(*image);
    if (!bytes)
        return failed(bytes.status(), kFailed);
    if (base::Status status = writeFileAtomically(arguments.output, *bytes); !status)
        return failed(status, kFailed);
    report(arguments, *image, *settings, *outcome);
    return kSuccess;
}

} // namespace

void addDazzleCommand(CLI::App& app, int& outExitCode)
{
    auto arguments = std::make_shared<DazzleArguments>();
    CLI::App* command = app.add_subcommand("dazzle", "Glare of a saturated sensor on an EXR picture");
    command->add_option("IN", arguments->input, "OpenEXR picture with channels R, G, B, or Y")->required();
    command->add_option("-o,--output", arguments->output, "OpenEXR picture to write")->required();
    command
        ->add_option("--sensor", arguments->sensor,
                     "A,B,C: of the mean overflow o per pixel, o (A + B exp(-C o)) comes back as glare")
        ->capture_default_str();
    command->add_option("--white", arguments->white, "Value at which a pixel saturates (8)");
    command
        ->add_option(
            "--algorithm", arguments->algorithm,
            "exact: integer sums over the full range; paper8: 256 levels, as published, without its faults")
        ->check(oneOf({"exact", "paper8"}))
        ->capture_default_str();
    command->add_flag("--json", arguments->json, "One object");
    command->callback([arguments, &outExitCode] { outExitCode = runDazzle(*arguments); });
}

} // namespace fx::cli
