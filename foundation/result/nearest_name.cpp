#include "foundation/result/nearest_name.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace fx::base {

namespace {

constexpr size_t kLongest = 64;

char lower(char c)
{
    return char(std::tolower(static_cast<unsigned char>(c)));
}

} // namespace

size_t editDistance(std::string_view a, std::string_view b)
{
    a = a.substr(0, kLongest);
    b = b.substr(0, kLongest);
    std::array<std::array<size_t, kLongest + 1>, 3> rows{}; // the row at hand and the two above it
    for (size_t j = 0; j <= b.size(); ++j)
        rows[0][j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
        auto& row = rows[i % 3];
        const auto& above = rows[(i + 2) % 3];
        const auto& twoAbove = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const bool same = lower(a[i - 1]) == lower(b[j - 1]);
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
            const bool swapped =
                i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
            if (swapped)
                row[j] = std::min(row[j], twoAbove[j - 2] + 1);
        }
    }
    return rows[a.size() % 3][b.size()];
}

std::optional<std::string> nearestName(std::string_view name, std::span<const std::string> known)
{
    std::optional<std::string> best;
    size_t bestDistance = 0;
    for (const std::string& candidate : known) {
        const size_t distance = editDistance(name, candidate);
        const size_t allowed = std::max<size_t>(2, std::min(candidate.size(), kLongest) / 3);
        if (distance <= allowed && distance < candidate.size() && (!best || distance < bestDistance)) {
            best = candidate;
            bestDistance = distance;
        }
    }
    return best;
}

std::string didYouMean(std::string_view name, std::span<const std::string> known)
{
    const std::optional<std::string> nearest = nearestName(name, known);
    return nearest ? "; did you mean \"" + *nearest + "\"?" : "";
}

} // namespace fx::base
