/// @file preset_value.h
/// Reads a validated object of a preset or scene, member by member, into definitions.
#pragma once

#include "foundation/math/curve.h"
#include "fxsdk/presets/findings.h"

#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fx::preset {

/// One JSON object whose types the schema has checked. Each read() sets `out` if the member exists; otherwise
/// `out` keeps its default. Conditions that a schema cannot express (min <= max, keys in order) are checked
/// here and reported as findings.
class PresetValue
{
public:
    /// Creates a reader of one JSON object.
    /// @param object null for an object without members
    PresetValue(const nlohmann::json* object, std::string pointer, Findings& findings)
        : object_(object), pointer_(std::move(pointer)), findings_(findings)
    {}

    bool has(const char* member) const;
    void read(const char* member, float& out) const;
    void read(const char* member, double& out) const;
    void read(const char* member, uint32_t& out) const;
    void read(const char* member, uint64_t& out) const;
    void read(const char* member, bool& out) const;
    void read(const char* member, std::string& out) const;
    void read(const char* member, glm::vec3& out) const; ///< a single number sets all three components
    void read(const char* member, glm::dvec3& out) const;
    void read(const char* member, std::array<float, 4>& out) const;
    void read(const char* member, base::Range& out) const;
    void read(const char* member, base::ScalarCurve& out) const;
    void read(const char* member, base::ColorCurve& out) const;
    /// Time [s] and value of each step of a member of the kind "steps" or "switches", without unit
    /// conversion. A single value is a step at time 0. Empty when the member is absent.
    std::vector<std::pair<double, double>> steps(const char* member) const;

    /// Reads one of the names in `choices` as an enumerator.
    template <class E>
    void read(const char* member, std::span<const std::pair<std::string_view, E>> choices, E& out) const
    {
        std::string name;
        read(member, name);
        for (const auto& [choice, value] : choices)
            if (name == choice)
                out = value;
    }

    /// The member as an object; an empty object when the member is absent.
    PresetValue child(const char* member) const;
    /// Number of elements of an array member, 0 when absent.
    size_t size(const char* member) const;
    PresetValue element(const char* member, size_t index) const;

    /// Reads element `index` of an array of vectors.
    void readElement(const char* member, size_t index, glm::vec3& out) const;
    /// Reads the bytes of the asset that the member names.
    /// @return the resolver's error, NotFound when the member is absent or no resolver is set
    base::Result<std::string> readAsset(const char* member, uint64_t maxBytes) const;
    /// Loader of the files that this document names; null if the document may not name files.
    asset::AssetLoader* assets() const { return findings_.assets(); }

    const std::string& pointer() const { return pointer_; }
    void error(const char* member, std::string message) const;
    void warning(const char* member, std::string message) const;

private:
    const nlohmann::json* find(const char* member) const;
    template <size_t N>
    void readCurve(const char* member, base::Curve<N>& out) const;

    const nlohmann::json* object_;
    std::string pointer_;
    Findings& findings_;
};

} // namespace fx::preset
