/// @file usage_message.h
/// Message about an invalid command line.
#pragma once

#include <string>

namespace CLI {
class App;
class Error;
} // namespace CLI

namespace fx::cli {

/// The parser's message. For each unknown argument, the nearest subcommand or option is suggested.
std::string usageMessage(const CLI::App* app, const CLI::Error& error);

} // namespace fx::cli
