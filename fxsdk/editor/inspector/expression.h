/// @file expression.h
/// Evaluates numbers that people type: arithmetic, constants and units, such as "2*pi" or "30 cm".
#pragma once

#include "foundation/result/status.h"

#include <string>
#include <string_view>
#include <vector>

namespace fx::editor {

/// Evaluates an expression.
///
/// Operators: + - * / ^ and parentheses; ^ binds most tightly and to the right. Functions: sqrt, abs, sin,
/// cos, tan, exp, log, min(a, b), max(a, b); angles are in radians. Constants: pi, e. A unit behind a number
/// or parenthesis multiplies it: "1.5 km/h", "(2 + 3) cm", "20 C" (Celsius).
/// @param unit unit of the member in the schema, such as "m/s" or "degree"; the result is in this unit. Empty
///        or "1": the expression must not have units
/// @return InvalidArgument with a message that names the place and the units that fit
base::Result<double> evaluate(std::string_view expression, std::string_view unit = {});

/// Names of units that can be converted to `unit`, such as "mm", "cm", "m", "km", "ft" and "in" for "m".
std::vector<std::string> unitsFor(std::string_view unit);

} // namespace fx::editor
