/// @file edit_command.cpp
/// fx edit: the effect editor, in a window or without a display.

#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/support/exit_code.h"
#ifdef FXSDK_EDITOR_PANELS
#include "fxsdk/editor/program/headless_editor.h"
#ifdef FXSDK_EDITOR_WINDOW
#include "fxsdk/editor/program/window_editor.h"
#endif
#endif

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace fx::cli {
namespace {

struct EditOptions
{
    std::string input;
    std::string script;
    std::string output;
    std::string recovery;
    int width = 1600;  ///< [pixel]
    int height = 1000; ///< [pixel]
    float scale = 0.0f;
    int measuredEdits = 0;
    bool isHeadless = false;
    bool isNew = false;
    bool isLinked = false;
    std::string link;
};

#ifdef FXSDK_EDITOR_PANELS

base::Status runEditor(const EditOptions& options)
{
    const std::filesystem::path recovery =
        options.recovery.empty() ? editor::recoveryFolder() : std::filesystem::path(options.recovery);
    auto session = options.isNew ? editor::Session::begin(options.input, recovery)
                                 : editor::Session::open(options.input, recovery);
    const bool isFile = !options.input.starts_with("library:");
    if (!session && session.status().code() == base::Code::NotFound && !options.isNew && isFile)
        return {base::Code::NotFound, session.status().message() + "; --new begins a file"};
    if (!session)
        return session.status();
    if (!options.isHeadless) {
#ifdef FXSDK_EDITOR_WINDOW
        return editor::runWindow(std::move(*session), {options.width, options.height, options.scale,
                                                       options.isLinked, options.link});
#else
        return {base::Code::NotFound,
                "this build has no window: GLFW was missing (Debian: libglfw3-dev); use --headless"};
#endif
    }
    const float scale = options.scale > 0.0f ? options.scale : 1.0f;
    return editor::runHeadless(std::move(*session),
                               {options.width, options.height, scale, options.script, options.output,
                                options.measuredEdits, options.isLinked, options.link});
}

#else

base::Status runEditor(const EditOptions&)
{
    return {
        base::Code::NotFound,
        "this build has no editor: Dear ImGui was missing or FXSDK_EDITOR was OFF; install libimgui-dev and "
        "configure with -DFXSDK_EDITOR=ON"};
}

#endif

int runEdit(const EditOptions& options)
{
    const base::Status status = runEditor(options);
    if (!status)
        std::fprintf(stderr, "fx edit: %s\n", status.message().c_str());
    return exitCodeOf(status);
}

} // namespace

void addEditCommand(CLI::App& app, int& outExitCode)
{
    auto options = std::make_shared<EditOptions>();
    CLI::App* command = app.add_subcommand("edit", "Edit presets (*.fx.json) and scenes (*.scene.json)");
    command->add_option("FILE", options->input, "*.fx.json, *.scene.json or library:NAME")->required();
    command->add_flag("--new", options->isNew,
                      "Begin FILE, which does not exist yet, with a column of smoke or a campfire");
    command->add_flag("--headless", options->isHeadless, "Draw the same frames without a display");
    command->add_option("--script", options->script, "Events of mouse and keyboard, with --headless");
    command->add_option("-o,--output", options->output, "PNG of the last frame, with --headless");
    command
        ->add_option("--measure", options->measuredEdits,
                     "Edits whose time until the picture is printed, with --headless")
        ->check(CLI::Range(1, 100000));
    command->add_option("--width", options->width, "Width of the window [pixel]")
        ->check(CLI::Range(640, 8192));
    command->add_option("--height", options->height, "Height of the window [pixel]")
        ->check(CLI::Range(480, 8192));
    command->add_option("--scale", options->scale, "Size of text [1]; default: that of the monitor")
        ->check(CLI::Range(0.5, 4.0));
    CLI::Option* const link = command->add_option(
        "--link", options->link,
        "Shows each edit in a running game: NAME, unix:PATH or tcp:127.0.0.1:PORT; default: the only one");
    link->expected(0, 1);
    command->add_option("--recovery", options->recovery, "Folder of recovery files");
    command->callback([options, link, &outExitCode] {
        options->isLinked = link->count() > 0;
        outExitCode = runEdit(*options);
    });
}

} // namespace fx::cli
