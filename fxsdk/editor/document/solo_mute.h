/// @file solo_mute.h
/// Shows some of a preset's emitters, gases and media, and hides the others.
///
/// Hidden elements keep their place in the preset, so that the random numbers of the others, and with them
/// their particles, do not change. The document itself is unchanged.
#pragma once

#include "fxsdk/editor/document/json_writer.h"

#include <set>
#include <string>
#include <vector>

namespace fx::editor {

/// Pointers to the elements that techniques add to a preset, such as "/emitters/0", in the order of the
/// document.
std::vector<std::string> soloElements(const Json& preset, const Json& schema);

class SoloMute
{
public:
    void setMuted(const std::string& element, bool isMuted);
    void setSolo(const std::string& element, bool isSolo);
    bool isMuted(const std::string& element) const { return muted_.contains(element); }
    bool isSolo(const std::string& element) const { return solo_.contains(element); }
    /// Whether the element is shown: it is not muted, and it is solo if any element is solo.
    bool isShown(const std::string& element) const;
    bool isActive() const { return !muted_.empty() || !solo_.empty(); }
    void clear();

    /// The preset to be shown instead of `preset`.
    /// @param schema schema of presets
    Json shown(const Json& preset, const Json& schema) const;

private:
    std::set<std::string> muted_;
    std::set<std::string> solo_;
};

} // namespace fx::editor
