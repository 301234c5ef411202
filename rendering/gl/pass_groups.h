/// @file pass_groups.h
/// Groups of passes. The times of all passes of a group are summed.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace fx::render {

/// A pass, and the group to which its time is added.
struct TimedPass
{
    std::string_view pass;
    std::string_view group = {}; ///< name of the group; empty: "other"
};

constexpr size_t kMaxPassGroups = 8;

/// Numbered groups of passes. Group 0, "other", contains passes without a group, and the passes of groups
/// beyond kMaxPassGroups.
class PassGroups
{
public:
    /// Adds passes to their groups.
    /// @param passes passes whose names must stay valid
    void add(std::span<const TimedPass> passes)
    {
        for (const TimedPass& timed : passes) {
            size_t group = find(timed.group);
            if (group == 0 && !timed.group.empty() && count_ < kMaxPassGroups)
                names_[group = count_++] = timed.group;
            passes_.push_back({timed.pass, group});
        }
    }

    size_t count() const { return count_; }
    std::string_view name(size_t group) const { return names_[group]; }
    /// Number of a group; 0 for an unknown name.
    size_t find(std::string_view name) const
    {
        for (size_t i = 1; i < count_; ++i)
            if (names_[i] == name)
                return i;
        return 0;
    }
    size_t groupOf(std::string_view pass) const
    {
        for (const Pass& known : passes_)
            if (known.name == pass)
                return known.group;
        return 0;
    }

private:
    struct Pass
    {
        std::string_view name;
        size_t group;
    };
    std::array<std::string_view, kMaxPassGroups> names_{"other"};
    size_t count_ = 1;
    std::vector<Pass> passes_;
};

} // namespace fx::render
