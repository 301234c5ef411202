#include "fxsdk/editor/inspector/member.h"

#include "fxsdk/presets/schema_explainer.h"
#include "fxsdk/presets/schema_validator.h"
#include "fxsdk/scene_file/stages.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fx::editor {

namespace {

using Pointer = Json::json_pointer;

constexpr auto kKinds = std::to_array<std::pair<std::string_view, MemberKind>>({
    {"range", MemberKind::Range},
    {"curve", MemberKind::Curve},
    {"colorCurve", MemberKind::ColorCurve},
    {"color", MemberKind::Color},
    {"vector", MemberKind::Vector},
    {"extent", MemberKind::Extent},
    {"steps", MemberKind::Steps},
    {"switches", MemberKind::Switches},
    {"number", MemberKind::Number},
    {"integer", MemberKind::Integer},
    {"boolean", MemberKind::Boolean},
    {"string", MemberKind::Text},
    {"array", MemberKind::Array},
    {"object", MemberKind::Object},
});

MemberKind kindOf(const Json& schema)
{
    if (schema.contains("enum"))
        return MemberKind::Choice;
    const std::string name = schema.value("x-kind", schema.value("type", std::string("object")));
    const auto found =
        std::find_if(kKinds.begin(), kKinds.end(), [&](const auto& k) { return k.first == name; });
    return found == kKinds.end() ? MemberKind::Object : found->second;
}

std::optional<double> boundOf(const Json& schema, const char* bound)
{
    const Json& number = schema.contains("x-number") ? schema["x-number"] : schema;
    return number.contains(bound) ? std::optional(number[bound].get<double>()) : std::nullopt;
}

Member describe(const std::string& name, const std::string& pointer, const Json& schema)
{
    Member member;
    member.name = name;
    member.pointer = pointer;
    member.title = schema.value("title", name);
    member.help = schema.value("description", std::string());
    member.cost = schema.value("x-cost", std::string());
    member.unit = schema.value("x-unit", std::string());
    member.unit = member.unit == "1" ? std::string() : member.unit;
    member.kind = kindOf(schema);
    member.minimum = boundOf(schema, "minimum");
    member.maximum = boundOf(schema, "maximum");
    if (schema.contains("enum"))
        for (const Json& choice : schema["enum"])
            member.choices.push_back(choice);
    if (schema.contains("default"))
        member.defaultValue = schema["default"];
    member.schema = &schema;
    return member;
}

const Json* objectSchema(const Document& document, const std::string& pointer)
{
    const Json* const schema = schemaAt(document.schema(), document.json(), Pointer(pointer));
    if (!schema)
        return nullptr;
    const Json absent;
    const Pointer at(pointer);
    const Json& part = decided(*schema, document.json().contains(at) ? document.json().at(at) : absent);
    return part.contains("properties") ? &part : nullptr;
}

bool isRequired(const Json& schema, const std::string& name)
{
    return schema.contains("required") &&
           std::find(schema["required"].begin(), schema["required"].end(), name) != schema["required"].end();
}

Json startNumber(const Json& schema)
{
    const double least = boundOf(schema, "minimum").value_or(0.0);
    const double most = boundOf(schema, "maximum").value_or(std::max(least, 0.0));
    const double value = std::clamp(1.0, least, std::max(least, most));
    return kindOf(schema) == MemberKind::Integer ? Json(int64_t(value)) : Json(value);
}

Json startObject(const Json& schema)
{
    Json object = Json::object();
    if (schema.contains("required"))
        for (const Json& name : schema["required"])
            object[name.get<std::string>()] = startValue(schema["properties"][name.get<std::string>()]);
    return object;
}

} // namespace

Json startValue(const Json& schema)
{
    if (schema.contains("default"))
        return schema["default"];
    switch (kindOf(schema)) {
    case MemberKind::Choice:
        return schema["enum"][0];
    case MemberKind::Boolean:
    case MemberKind::Switches:
        return false;
    case MemberKind::Text:
        return std::string(schema.value("minLength", size_t(0)), '?');
    case MemberKind::Object:
        return startObject(schema);
    case MemberKind::Array: {
        Json elements = Json::array();
        for (size_t i = 0; i < schema.value("minItems", size_t(0)); ++i)
            elements.push_back(startValue(schema["items"].is_array() ? schema["items"][i] : schema["items"]));
        return elements;
    }
    case MemberKind::Vector: // a place or angles
        if (boundOf(schema, "minimum").value_or(0.0) <= 0.0 &&
            boundOf(schema, "maximum").value_or(0.0) >= 0.0)
            return Json::array({0, 0, 0});
        [[fallthrough]];
    case MemberKind::Color:
    case MemberKind::ColorCurve: {
        const Json number = startNumber(schema);
        return Json::array({number, number, number});
    }
    default:
        return startNumber(schema);
    }
}

std::vector<Member> membersOf(const Document& document, const std::string& pointer)
{
    std::vector<Member> members;
    const Json* const schema = objectSchema(document, pointer);
    if (!schema)
        return members;
    const Json& properties = (*schema)["properties"];
    for (auto it = properties.begin(); it != properties.end(); ++it) {
        const std::string at = pointer + (Pointer() / it.key()).to_string();
        Member member = describe(it.key(), at, *it);
        member.isRequired = isRequired(*schema, it.key());
        member.isPresent = document.json().contains(Pointer(at));
        members.push_back(std::move(member));
    }
    return members;
}

std::vector<Member> elementsOf(const Document& document, const std::string& pointer)
{
    std::vector<Member> elements;
    const Pointer at(pointer);
    if (!document.json().contains(at) || !document.json().at(at).is_array())
        return elements;
    for (size_t i = 0; i < document.json().at(at).size(); ++i)
        if (auto member = memberAt(document, pointer + "/" + std::to_string(i)))
            elements.push_back(std::move(*member));
    return elements;
}

std::optional<Member> memberAt(const Document& document, const std::string& pointer)
{
    const Pointer at(pointer);
    const Json* const schema = schemaAt(document.schema(), document.json(), at);
    if (!schema || at.empty())
        return std::nullopt;
    Member member = describe(at.back(), pointer, *schema);
    const Json* const parent = objectSchema(document, at.parent_pointer().to_string());
    member.isRequired = parent && isRequired(*parent, at.back());
    member.isPresent = document.json().contains(at);
    if (const Json* const array = schemaAt(document.schema(), document.json(), at.parent_pointer());
        array && member.help.empty()) // elements are described with their array
        member.help = array->value("description", std::string());
    return member;
}

std::vector<std::string> unknownMembersOf(const Document& document, const std::string& pointer)
{
    std::vector<std::string> unknown;
    const Pointer at(pointer);
    const Json* const schema = objectSchema(document, pointer);
    if (!schema || !document.json().contains(at) || !document.json().at(at).is_object())
        return unknown;
    const Json& object = document.json().at(at);
    for (auto it = object.begin(); it != object.end(); ++it)
        if (!(*schema)["properties"].contains(it.key()))
            unknown.push_back(it.key());
    return unknown;
}

std::optional<Json> impliedValue(const Document& document, const std::string& pointer)
{
    static const Json stage = Json::parse(scene_file::stages()[0].members);
    constexpr std::string_view kPreview = "/preview";
    if (document.kind() != DocumentKind::Preset || !pointer.starts_with(std::string(kPreview) + "/"))
        return std::nullopt;
    const Pointer at(pointer.substr(kPreview.size()));
    Pointer outermost = at;
    while (outermost.parent_pointer() != Pointer())
        outermost.pop_back();
    const bool isStated = document.json().contains(Pointer(std::string(kPreview) + outermost.to_string()));
    return !isStated && stage.contains(at) ? std::optional<Json>(stage.at(at)) : std::nullopt;
}

bool hasValue(const Document& document, const Member& member)
{
    return member.isPresent || member.defaultValue || impliedValue(document, member.pointer);
}

base::Status setMember(Document& io, const std::string& pointer, Json value, uint64_t gesture)
{
    Pointer around(pointer);
    const std::string name = around.back();
    around.pop_back();
    if (around.empty() || io.json().contains(around))
        return io.set(pointer, std::move(value), gesture);
    const Json* const schema = schemaAt(io.schema(), io.json(), around);
    const auto implied = impliedValue(io, around.to_string());
    Json object = implied && implied->is_object()                   ? *implied
                  : schema && kindOf(*schema) == MemberKind::Object ? startObject(*schema)
                                                                    : Json::object();
    object[name] = std::move(value);
    return io.set(around.to_string(), std::move(object), gesture);
}

Json valueOf(const Document& document, const Member& member)
{
    const Pointer at(member.pointer);
    if (document.json().contains(at))
        return document.json().at(at);
    if (auto implied = impliedValue(document, member.pointer))
        return *implied;
    return member.schema ? startValue(*member.schema) : Json();
}

bool differsFromDefault(const Document& document, const Member& member)
{
    const Pointer at(member.pointer);
    if (!document.json().contains(at))
        return false;
    return !member.defaultValue || document.json().at(at) != *member.defaultValue;
}

base::Status check(const Member& member, const Json& value)
{
    const nlohmann::json schema = *member.schema;
    nlohmann::json plain = value;
    preset::Findings findings;
    preset::SchemaValidator(schema).validate(plain, {}, findings);
    if (!findings.hasErrors())
        return {};
    return {base::Code::InvalidArgument, member.pointer + ": found " + preset::foundText(plain) +
                                             "; allowed is " + preset::allowedText(schema)};
}

Json limited(const Member& member, double value)
{
    if (member.minimum)
        value = std::max(value, *member.minimum);
    if (member.maximum)
        value = std::min(value, *member.maximum);
    if (member.kind == MemberKind::Integer)
        return int64_t(std::llround(value));
    return value;
}

} // namespace fx::editor
