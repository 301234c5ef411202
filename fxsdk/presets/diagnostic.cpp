#include "fxsdk/presets/diagnostic.h"

#include <algorithm>

namespace fx::preset {

namespace {

/// Length of the well-formed UTF-8 sequence that begins at text[i]; 0 when there is none.
size_t sequenceLength(const std::string& text, size_t i)
{
    const auto byte = [&](size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
    const unsigned lead = byte(i);
    const size_t length = lead < 0x80                   ? 1
                          : lead >= 0xC2 && lead < 0xE0 ? 2
                          : lead >= 0xE0 && lead < 0xF0 ? 3
                          : lead >= 0xF0 && lead < 0xF5 ? 4
                                                        : 0;
    for (size_t k = 1; k < length; ++k)
        if ((byte(i + k) & 0xC0) != 0x80)
            return 0;
    return length;
}

} // namespace

std::string toString(const Diagnostic& diagnostic)
{
    std::string text = diagnostic.file;
    if (diagnostic.line > 0)
        text += ":" + std::to_string(diagnostic.line) + ":" + std::to_string(diagnostic.column);
    text += ": ";
    if (!diagnostic.pointer.empty())
        text += diagnostic.pointer + ": ";
    return text + diagnostic.message;
}

bool hasErrors(const std::vector<Diagnostic>& diagnostics)
{
    return std::any_of(diagnostics.begin(), diagnostics.end(),
                       [](const Diagnostic& d) { return !d.warning; });
}

std::string summary(const std::vector<Diagnostic>& diagnostics)
{
    constexpr size_t kLimit = 1024;
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) {
        if (diagnostic.warning)
            continue;
        std::string line(text.empty() ? "" : "\n");
        line += toString(diagnostic);
        if (text.size() + line.size() > kLimit)
            return text.empty() ? printable(line, kLimit) : text;
        text += line;
    }
    return text;
}

std::string printable(const std::string& text, size_t limit)
{
    std::string result;
    for (size_t i = 0; i < text.size();) {
        const size_t length = sequenceLength(text, i);
        if (result.size() + std::max<size_t>(length, 1) > limit)
            break;
        const bool isControl = static_cast<unsigned char>(text[i]) < 0x20 || text[i] == 0x7F;
        if (length == 0 || isControl)
            result += '?';
        else
            result.append(text, i, length);
        i += std::max<size_t>(length, 1);
    }
    return result;
}

} // namespace fx::preset
