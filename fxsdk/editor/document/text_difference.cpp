#include "fxsdk/editor/document/text_difference.h"

#include <algorithm>
#include <cstdint>

namespace fx::editor {

namespace {

using Lines = std::vector<std::string_view>;

constexpr size_t kTableCells = size_t(1) << 24; // above it the middle is shown as replaced

Lines linesOf(std::string_view text)
{
    Lines lines;
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

void append(std::vector<DifferenceLine>& io, char mark, const Lines& lines, size_t begin, size_t end)
{
    for (size_t i = begin; i < end; ++i)
        io.push_back({mark, std::string(lines[i])});
}

/// Longest common subsequence of the middles [head, ends).
void compareMiddle(const Lines& a, const Lines& b, size_t head, size_t endA, size_t endB,
                   std::vector<DifferenceLine>& io)
{
    const size_t rows = endA - head;
    const size_t columns = endB - head;
    if ((rows + 1) * (columns + 1) > kTableCells) {
        append(io, '-', a, head, endA);
        append(io, '+', b, head, endB);
        return;
    }
    std::vector<uint32_t> common((rows + 1) * (columns + 1), 0);
    const auto at = [&](size_t i, size_t j) -> uint32_t& { return common[i * (columns + 1) + j]; };
    for (size_t i = rows; i-- > 0;)
        for (size_t j = columns; j-- > 0;)
            at(i, j) =
                a[head + i] == b[head + j] ? at(i + 1, j + 1) + 1 : std::max(at(i + 1, j), at(i, j + 1));
    size_t i = 0;
    size_t j = 0;
    while (i < rows || j < columns) {
        if (i < rows && j < columns && a[head + i] == b[head + j]) {
            append(io, ' ', a, head + i, head + i + 1);
            ++i;
            ++j;
        } else if (j == columns || (i < rows && at(i + 1, j) >= at(i, j + 1))) {
            append(io, '-', a, head + i, head + i + 1);
            ++i;
        } else {
            append(io, '+', b, head + j, head + j + 1);
            ++j;
        }
    }
}

/// Leaves out equal lines that are farther than `context` lines from a difference.
std::vector<DifferenceLine> shortened(const std::vector<DifferenceLine>& all, size_t context)
{
    std::vector<bool> isKept(all.size(), false);
    for (size_t i = 0; i < all.size(); ++i)
        if (all[i].mark != ' ')
            for (size_t k = i - std::min(i, context); k < std::min(all.size(), i + context + 1); ++k)
                isKept[k] = true;
    std::vector<DifferenceLine> lines;
    for (size_t i = 0; i < all.size(); ++i)
        if (isKept[i])
            lines.push_back(all[i]);
        else if (lines.empty() || lines.back().text != "...")
            lines.push_back({' ', "..."});
    return lines;
}

} // namespace

std::vector<DifferenceLine> difference(std::string_view before, std::string_view after, size_t context)
{
    if (before == after)
        return {};
    const Lines a = linesOf(before);
    const Lines b = linesOf(after);
    size_t head = 0;
    while (head < std::min(a.size(), b.size()) && a[head] == b[head])
        ++head;
    size_t endA = a.size();
    size_t endB = b.size();
    while (endA > head && endB > head && a[endA - 1] == b[endB - 1]) {
        --endA;
        --endB;
    }
    std::vector<DifferenceLine> all;
    append(all, ' ', a, 0, head);
    compareMiddle(a, b, head, endA, endB, all);
    append(all, ' ', a, endA, a.size());
    return shortened(all, context);
}

std::string toString(const std::vector<DifferenceLine>& lines)
{
    std::string text;
    for (const DifferenceLine& line : lines)
        text.append(1, line.mark).append(line.text).append("\n");
    return text;
}

} // namespace fx::editor
