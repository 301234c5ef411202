#include "fxsdk/presets/schema_explainer.h"

#include "foundation/result/nearest_name.h"
#include "fxsdk/presets/json_sax.h"
#include "fxsdk/techniques.h"

namespace fx::preset {

namespace {

using Json = nlohmann::json;

/// `schema` with its if/then/else decided for `value`.
const Json& decided(const Json& schema, const Json& value)
{
    if (!schema.is_object() || !schema.contains("if"))
        return schema;
    const bool wantsArray = schema["if"]["type"] == "array";
    const bool fits = wantsArray ? value.is_array() : value.is_object();
    return schema[fits ? "then" : "else"];
}

bool hasType(const Json& value, const std::string& type)
{
    if (type == "object")
        return value.is_object();
    if (type == "array")
        return value.is_array();
    if (type == "string")
        return value.is_string();
    if (type == "boolean")
        return value.is_boolean();
    if (type == "integer")
        return value.is_number_integer();
    return value.is_number();
}

std::string text(const Json& number)
{
    std::string digits = number.dump();
    if (digits.ends_with(".0"))
        digits.resize(digits.size() - 2);
    return digits;
}

std::string bounds(const Json& schema)
{
    const bool hasMinimum = schema.contains("minimum");
    const bool hasMaximum = schema.contains("maximum");
    if (hasMinimum && hasMaximum)
        return " from " + text(schema["minimum"]) + " to " + text(schema["maximum"]);
    if (hasMinimum)
        return " of at least " + text(schema["minimum"]);
    return hasMaximum ? " of at most " + text(schema["maximum"]) : "";
}

std::string kindText(const std::string& kind, const std::string& number)
{
    if (kind == "range")
        return "a number" + number + " or {\"min\": a, \"max\": b} of such numbers";
    if (kind == "curve")
        return "a number" + number + " or {\"keys\": [[t, value], ...]} of such numbers with t from 0 to 1";
    if (kind == "colorCurve")
        return "[r, g, b] with numbers" + number + " or {\"keys\": [[t, [r, g, b]], ...]} with t from 0 to 1";
    if (kind == "color")
        return "[r, g, b] with numbers" + number;
    if (kind == "extent")
        return "a number" + number + " or [x, y, z] of such numbers";
    if (kind == "steps")
        return "a number" + number + " or {\"steps\": [[time, value], ...]} of such numbers";
    if (kind == "switches")
        return "true, false or {\"steps\": [[time, value], ...]} of these";
    return "[x, y, z] with numbers" + number;
}

std::string enumText(const Json& values)
{
    std::string list;
    for (const Json& value : values)
        list += (list.empty() ? "" : ", ") + value.dump();
    return "one of " + list;
}

std::string countText(const Json& schema)
{
    const size_t least = schema.value("minItems", size_t(0));
    const size_t most = schema.value("maxItems", size_t(0));
    if (least == most && most > 0)
        return "an array of " + std::to_string(most) + " elements";
    if (most > 0)
        return "an array of " + std::to_string(least) + " to " + std::to_string(most) + " elements";
    return "an array";
}

bool violatesArray(const Json& schema, const Json& value)
{
    return (schema.contains("minItems") && value.size() < schema["minItems"].get<size_t>()) ||
           (schema.contains("maxItems") && value.size() > schema["maxItems"].get<size_t>());
}

bool violatesScalar(const Json& schema, const Json& value)
{
    if (value.is_number() && schema.contains("minimum") &&
        value.get<double>() < schema["minimum"].get<double>())
        return true;
    if (value.is_number() && schema.contains("maximum") &&
        value.get<double>() > schema["maximum"].get<double>())
        return true;
    if (schema.contains("enum")) {
        for (const Json& allowed : schema["enum"])
            if (allowed == value)
                return false;
        return true;
    }
    if (!value.is_string())
        return false;
    const size_t length = value.get_ref<const std::string&>().size();
    return length < schema.value("minLength", size_t(0)) || length > schema.value("maxLength", size_t(4096));
}

/// "; did you mean ...?" where `value` looks like one of the names that are allowed.
std::string guessText(const Json& schema, const Json& value)
{
    if (!schema.contains("enum") || !value.is_string())
        return {};
    std::vector<std::string> known;
    for (const Json& allowed : schema["enum"])
        if (allowed.is_string())
            known.push_back(allowed.get<std::string>());
    return base::didYouMean(value.get_ref<const std::string&>(), known);
}

std::string unknownMemberText(const std::string& name, const std::vector<std::string>& known)
{
    for (const MissingTechnique& missing : missingTechniques())
        if (missing.presetMember == name)
            return "this build lacks \"" + name + "\": it was configured with " +
                   std::string(missing.option) + "=OFF";
    std::string message = "unknown member \"" + name + "\"";
    if (const std::string question = base::didYouMean(name, known); !question.empty())
        return message + question;
    message += "; known here:";
    for (const std::string& candidate : known)
        message += " " + candidate;
    return message;
}

size_t explainObject(const Json& schema, const Json& value, const std::string& pointer, Findings& findings)
{
    const size_t before = findings.size();
    const Json& properties = schema["properties"];
    std::vector<std::string> known;
    for (const auto& [name, member] : properties.items())
        known.push_back(name);
    for (const auto& [name, member] : value.items()) {
        if (findings.full())
            break;
        if (!properties.contains(name))
            findings.errorAtKey(pointer + "/" + escapePointer(name), unknownMemberText(name, known));
    }
    for (const Json& name : schema.value("required", Json::array())) {
        const std::string& key = name.get_ref<const std::string&>();
        if (!value.contains(key))
            findings.error(pointer,
                           "the member \"" + key + "\" is missing; it holds " + allowedText(properties[key]));
    }
    return findings.size() - before;
}

} // namespace

const nlohmann::json* schemaAt(const nlohmann::json& schema, const nlohmann::json& document,
                               const nlohmann::json::json_pointer& pointer)
{
    std::vector<std::string> path;
    for (auto rest = pointer; !rest.empty(); rest.pop_back())
        path.insert(path.begin(), rest.back());

    const Json* part = &schema;
    const Json* value = &document;
    for (const std::string& token : path) {
        const Json& here = decided(*part, *value);
        if (value->is_array() && here.contains("items")) {
            const size_t index = std::stoul(token);
            const Json& items = here["items"];
            if (index >= value->size() || (items.is_array() && index >= items.size()))
                return nullptr;
            part = items.is_array() ? &items[index] : &items;
            value = &(*value)[index];
        } else if (value->is_object() && here.contains("properties") && here["properties"].contains(token) &&
                   value->contains(token))
        {
            part = &here["properties"][token];
            value = &(*value)[token];
        } else
            return nullptr;
    }
    return part;
}

std::string allowedText(const nlohmann::json& schema)
{
    std::string allowed;
    const std::string type = schema.value("type", std::string());
    if (schema.contains("x-kind"))
        allowed = kindText(schema["x-kind"].get<std::string>(), bounds(schema["x-number"]));
    else if (schema.contains("enum"))
        allowed = enumText(schema["enum"]);
    else if (type == "array")
        allowed = countText(schema);
    else if (type == "number")
        allowed = "a number" + bounds(schema);
    else if (type == "integer")
        allowed = "a whole number" + bounds(schema);
    else if (type == "boolean")
        allowed = "true or false";
    else if (type == "string")
        allowed = "a string of at most " + std::to_string(schema.value("maxLength", 4096)) + " bytes";
    else
        allowed = "an object";
    const std::string unit = schema.value("x-unit", std::string("1"));
    return unit == "1" ? allowed : allowed + " [" + unit + "]";
}

std::string foundText(const nlohmann::json& value)
{
    if (value.is_object())
        return "an object";
    if (value.is_array())
        return "an array of " + std::to_string(value.size()) + " elements";
    if (value.is_string())
        return "\"" + printable(value.get_ref<const std::string&>(), 48) + "\"";
    return value.dump();
}

size_t explain(const nlohmann::json& schema, const nlohmann::json& value, const std::string& pointer,
               Findings& findings)
{
    const Json& here = decided(schema, value);
    const std::string type = here.value("type", std::string());
    if (type == "object" && value.is_object())
        return explainObject(here, value, pointer, findings);
    const bool isWrong = (!type.empty() && !hasType(value, type)) ||
                         (value.is_array() ? violatesArray(here, value) : violatesScalar(here, value));
    if (!isWrong)
        return 0;
    // Inside a chosen branch the branch says more than the choice: [1, 2] where a color is wanted.
    const bool branchFits = &here != &schema && hasType(value, type);
    findings.error(pointer, "found " + foundText(value) + "; allowed is " +
                                allowedText(branchFits ? here : schema) + guessText(here, value));
    return 1;
}

} // namespace fx::preset
