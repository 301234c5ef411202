/// @file named_choice.h
/// Options whose value is one of a few names.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class Validator;
}

namespace fx::cli {

/// Accepts one of `names`; the message about another value lists them and suggests the nearest.
CLI::Validator oneOf(std::vector<std::string> names);

} // namespace fx::cli
