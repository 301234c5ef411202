/// @file doctor_command.cpp
/// fx doctor: what this machine offers, what is missing and how to install it.

#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/inspect/doctor.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/ffmpeg_pipe.h"
#include "fxsdk/cli/support/json_line.h"
#include "rendering/gl/gl_device.h"
#include "rendering/platform/gl_context.h"
#include "rendering/vdb/vdb_volume.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <memory_resource>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

constexpr uint64_t kMebibyte = uint64_t(1) << 20;

Check checkDevices()
{
    Check check{"EGL devices", true, false, "", ""};
    for (const std::string& name : eglDevices())
        check.detail += (check.detail.empty() ? "" : ", ") + name;
    if (check.detail.empty())
        check.detail = "none are listed";
    return check;
}

/// Makes a context as fx render does; fills in the machine's renderer.
Check checkGl(Machine& machine)
{
    Check check{"OpenGL 4.5", false, true, "",
                "apt-get install libegl1 libgl1-mesa-dri (software rendering), or a GPU "
                "driver with EGL"};
    auto context = render::createEglContext({});
    if (!context.ok()) {
        check.detail = context.status().message();
        return check;
    }
    auto device = render::GlDevice::create((*context)->loader(), std::pmr::get_default_resource());
    if (!device.ok()) {
        check.detail = device.status().message();
        return check;
    }
    machine.glRenderer = (*device)->limits().renderer;
    check.ok = true;
    check.detail =
        machine.glRenderer + ", " + (*device)->limits().versionText + ", " + (*context)->description();
    return check;
}

Check checkFfmpeg()
{
    const std::string program = findFfmpeg().string();
    return {"ffmpeg", !program.empty(), false, program.empty() ? "not found: no MP4 output" : program,
            "apt-get install ffmpeg"};
}

Check checkOpenVdb()
{
    const std::string version = render::vdbVersion();
    return {"OpenVDB", !version.empty(), false,
            version.empty() ? "fx was built without it: no fx export, no fx import" : version,
            "apt-get install libopenvdb-dev libboost-dev, then configure and build fx again"};
}

Check checkDisplay()
{
    const char* const display = std::getenv("DISPLAY");
    const char* const wayland = std::getenv("WAYLAND_DISPLAY");
    const std::string name = display != nullptr ? display : wayland != nullptr ? wayland : "";
    return {"display", !name.empty(), false, name.empty() ? "none: examples with a window need one" : name,
            "apt-get install xvfb xauth, then xvfb-run PROGRAM"};
}

void printText(const Machine& machine, const std::vector<Check>& checks)
{
    std::printf("fx %s\n", FXSDK_VERSION);
    std::printf("CPU           %s\n", machine.cpu.c_str());
    std::printf("cores         %d\n", machine.cores);
    std::printf("SIMD          %s\n", machine.simd.c_str());
    std::printf("memory        %llu MiB\n", static_cast<unsigned long long>(machine.memory / kMebibyte));
    for (const Check& check : checks) {
        std::printf("%-13s %s%s\n", check.name.c_str(), check.ok ? "" : "MISSING: ", check.detail.c_str());
        if (!check.ok)
            std::printf("%-13s -> %s\n", "", check.remedy.c_str());
    }
}

void printJson(const Machine& machine, const std::vector<Check>& checks)
{
    nlohmann::json list = nlohmann::json::array();
    for (const Check& check : checks) {
        nlohmann::json entry = {
            {"name", check.name}, {"ok", check.ok}, {"required", check.required}, {"detail", check.detail}};
        if (!check.ok)
            entry["remedy"] = check.remedy;
        list.push_back(entry);
    }
    printJsonLine(withMachine({{"checks", list}}, machine));
}

int runDoctor(bool json)
{
    Machine machine = readMachine();
    const std::vector<Check> checks = {checkDevices(), checkGl(machine), checkFfmpeg(), checkOpenVdb(),
                                       checkDisplay()};
    if (json)
        printJson(machine, checks);
    else
        printText(machine, checks);
    for (const Check& check : checks) {
        if (check.required && !check.ok)
            return kFailed;
    }
    return kSuccess;
}

} // namespace

void addDoctorCommand(CLI::App& app, int& outExitCode)
{
    auto json = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("doctor", "Show what this machine offers and what is missing");
    command->add_flag("--json", *json, "One object: machine, checks");
    command->callback([json, &outExitCode] { outExitCode = runDoctor(*json); });
}

} // namespace fx::cli
