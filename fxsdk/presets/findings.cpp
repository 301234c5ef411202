#include "fxsdk/presets/findings.h"

#include "fxsdk/presets/json_locator.h"

#include <algorithm>

namespace fx::preset {

namespace {

constexpr size_t kMessageLimit = 1000; // with file and place still about 1 KiB

/// The pointer that the text knew before migration; longest renamed prefix first.
std::string originalPointer(const std::string& pointer, const std::vector<Renaming>& renamings)
{
    const Renaming* best = nullptr;
    for (const Renaming& renaming : renamings) {
        const bool isPrefix = pointer.starts_with(renaming.now) &&
                              (pointer.size() == renaming.now.size() || pointer[renaming.now.size()] == '/');
        if (isPrefix && (!best || renaming.now.size() > best->now.size()))
            best = &renaming;
    }
    return best ? best->before + pointer.substr(best->now.size()) : pointer;
}

Diagnostic place(const Finding& finding, size_t offset, std::string_view text, const std::string& file)
{
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const size_t lineStart = before.rfind('\n') + 1; // npos + 1 is 0: the first line
    Diagnostic diagnostic;
    diagnostic.file = printable(file, 256);
    diagnostic.line = 1 + int(std::count(before.begin(), before.end(), '\n'));
    diagnostic.column = 1 + int(before.size() - lineStart);
    diagnostic.pointer = printable(finding.pointer, 256);
    diagnostic.message = printable(finding.message, kMessageLimit);
    diagnostic.warning = finding.warning;
    return diagnostic;
}

} // namespace

void Findings::add(Finding finding)
{
    if (!finding.warning && firstCode_ == base::Code::Ok)
        firstCode_ = finding.code;
    if (!full())
        list_.push_back(std::move(finding));
}

void Findings::error(std::string pointer, std::string message, base::Code code)
{
    add({std::move(pointer), std::move(message), code});
}

void Findings::errorAtKey(std::string pointer, std::string message)
{
    add({std::move(pointer), std::move(message), base::Code::Schema, true});
}

void Findings::errorAtOffset(std::string pointer, std::string message, base::Code code, size_t offset)
{
    add({std::move(pointer), std::move(message), code, false, false, offset});
}

void Findings::warning(std::string pointer, std::string message)
{
    add({std::move(pointer), std::move(message), base::Code::Schema, false, true});
}

std::vector<Diagnostic> Findings::locate(std::string_view text, const std::string& file) const
{
    std::vector<std::string> pointers; // of the findings whose place is not known yet
    for (const Finding& finding : list_)
        if (finding.offset == kUnknownOffset)
            pointers.push_back(originalPointer(finding.pointer, renamings_));
    const std::vector<JsonPlace> places =
        pointers.empty() ? std::vector<JsonPlace>() : locateJson(text, pointers);

    auto next = places.begin();
    std::vector<std::pair<size_t, Diagnostic>> located;
    for (const Finding& finding : list_) {
        size_t offset = finding.offset;
        if (offset == kUnknownOffset) {
            offset = finding.atKey ? next->key : next->value;
            ++next;
        }
        located.emplace_back(offset, place(finding, offset, text, file));
    }
    std::stable_sort(located.begin(), located.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Diagnostic> diagnostics;
    for (auto& [offset, diagnostic] : located)
        diagnostics.push_back(std::move(diagnostic));
    return diagnostics;
}

} // namespace fx::preset
