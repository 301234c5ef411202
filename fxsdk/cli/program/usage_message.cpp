#include "fxsdk/cli/program/usage_message.h"

#include "foundation/result/nearest_name.h"

#include <CLI/CLI.hpp>

#include <string_view>
#include <vector>

namespace fx::cli {
namespace {

std::vector<std::string> optionsOf(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        if (!option->get_group().empty()) // no group: not for users
            for (const std::string& name : option->get_lnames())
                names.push_back("--" + name);
    return names;
}

std::vector<std::string> subcommandsOf(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

/// Of `app` and of the subcommands that the command line names.
void addUnknown(const CLI::App& app, std::string& io)
{
    for (const std::string& argument : app.remaining()) {
        const bool isOption = argument.starts_with("-");
        const std::string name = argument.substr(0, isOption ? argument.find('=') : std::string::npos);
        const std::string question = base::didYouMean(name, isOption ? optionsOf(app) : subcommandsOf(app));
        if (!question.empty())
            io += "unknown " + std::string(isOption ? "option" : "subcommand") + " \"" + name + "\" of " +
                  app.get_display_name() + question + "\n";
    }
    for (const CLI::App* command : app.get_subcommands())
        addUnknown(*command, io);
}

} // namespace

std::string usageMessage(const CLI::App* app, const CLI::Error& error)
{
    std::string message;
    addUnknown(*app, message);
    return message + CLI::FailureMessage::simple(app, error);
}

} // namespace fx::cli
