/// @file member_probe.h
/// Checks that the reader reads each member of a schema, and that the documented defaults are correct.
#pragma once

#include "fxsdk/presets/preset_loader.h"
#include "fxsdk/presets/schema_assembly.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace fx::test {

using Json = nlohmann::json;

/// All values of the definition of a solver, as numbers.
using Fields = std::vector<double>;
using FieldsOf = std::function<Fields(const sim::SolverDef&)>;

/// Loads a preset whose array `member` has only the element `element`. Returns the values of the solver of
/// this element.
inline Fields load(const std::string& member, const Json& element, const FieldsOf& fieldsOf)
{
    const Json document{{"version", 1}, {member, Json::array({element})}};
    const auto loaded = preset::loadPresetText(document.dump(), "probe");
    if (!loaded.ok()) {
        ADD_FAILURE() << loaded.status().message() << "\n" << document.dump();
        return {};
    }
    return fieldsOf(*loaded->effect->solvers.at(0));
}

/// A value that the schema allows and that differs from the default.
inline Json otherValue(const Json& member)
{
    if (member.contains("enum"))
        return member["enum"].back() == member["default"] ? member["enum"].front() : member["enum"].back();
    if (member.value("type", "") == "boolean")
        return !member["default"].get<bool>();
    const Json number = member.value("x-number", member);
    const double low = number["minimum"].get<double>();
    const double high = number["maximum"].get<double>();
    const double other = low + 0.37 * (high - low);
    if (member.value("type", "") == "integer")
        return int64_t(other);
    const std::string kind = member.value("x-kind", "");
    if (kind == "vector" || kind == "colorCurve" || kind == "extent")
        return Json::array({other, 0.5 * (low + other), low});
    return other;
}

/// Tests each plain member of the schema `object`. The reader must read the member, and its default must be
/// the documented default.
inline void probeMembers(const std::string& presetMember, const Json& object, const Json& element,
                         const std::string& where, const FieldsOf& fieldsOf)
{
    const Fields untouched = load(presetMember, element, fieldsOf);
    for (const auto& [name, member] : object["properties"].items()) {
        if (!member.contains("default") || member.value("type", "") == "string")
            if (!member.contains("enum"))
                continue;
        const Json::json_pointer pointer(where + "/" + name);
        Json withDefault = element;
        withDefault[pointer] = member["default"];
        EXPECT_EQ(load(presetMember, withDefault, fieldsOf), untouched)
            << where << "/" << name << ": the documented default is not the real one";
        Json withOther = element;
        withOther[pointer] = otherValue(member);
        EXPECT_NE(load(presetMember, withOther, fieldsOf), untouched)
            << where << "/" << name << " is not read";
    }
}

inline void add(Fields& fields, const glm::vec3& v)
{
    fields.insert(fields.end(), {v.x, v.y, v.z});
}

inline void add(Fields& fields, const base::Range& range)
{
    fields.insert(fields.end(), {range.min, range.max});
}

template <size_t N>
void add(Fields& fields, const base::Curve<N>& curve)
{
    for (const float t : {0.0f, 0.25f, 0.5f, 1.0f})
        for (const float value : curve.at(t))
            fields.push_back(value);
}

} // namespace fx::test
