/// @file diagnostic.h
/// Findings about a preset or scene. Each finding states a position in the file and a remedy.
#pragma once

#include <string>
#include <vector>

namespace fx::preset {

/// One finding.
struct Diagnostic
{
    std::string file;    ///< file name for messages
    int line = 0;        ///< line, from 1; 0 when the finding concerns the whole file
    int column = 0;      ///< [byte] column, from 1
    std::string pointer; ///< JSON pointer, "" for the whole document
    /// description of the value found and of the allowed values, at most 1 KiB, printable UTF-8
    std::string message;
    bool warning = false; ///< true: the file can be used despite the finding
};

/// Formats a finding as "file:line:column: /pointer: message".
std::string toString(const Diagnostic& diagnostic);

/// Whether any of the findings is an error.
bool hasErrors(const std::vector<Diagnostic>& diagnostics);

/// Text of the first errors, one per line, at most 1 KiB.
std::string summary(const std::vector<Diagnostic>& diagnostics);

/// Returns `text` cut to `limit` bytes, with control characters and bytes that are not UTF-8 replaced by '?'.
std::string printable(const std::string& text, size_t limit);

} // namespace fx::preset
