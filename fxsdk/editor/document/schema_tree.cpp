#include "fxsdk/editor/document/schema_tree.h"

#include "fxsdk/presets/schema_assembly.h"

#include <algorithm>
#include <vector>

namespace fx::editor {

namespace {

/// The schema of a member or element of a value with the schema `schema`; null if there is none.
const Json* childSchema(const Json& schema, const std::string& token)
{
    if (schema.contains("properties")) {
        const Json& properties = schema["properties"];
        return properties.contains(token) ? &properties[token] : nullptr;
    }
    if (!schema.contains("items") || token.empty() ||
        !std::all_of(token.begin(), token.end(), [](char c) { return c >= '0' && c <= '9'; }))
        return nullptr;
    const Json& items = schema["items"];
    if (!items.is_array())
        return &items;
    const size_t index = token.size() < 9 ? std::stoul(token) : items.size();
    return index < items.size() ? &items[index] : nullptr;
}

size_t placeIn(const Json& properties, const std::string& key)
{
    size_t place = 0;
    for (auto it = properties.begin(); it != properties.end() && it.key() != key; ++it)
        ++place;
    return place;
}

} // namespace

const Json& schemaOf(DocumentKind kind)
{
    static const Json preset = preset::presetSchema();
    static const Json scene = preset::sceneSchema();
    return kind == DocumentKind::Preset ? preset : scene;
}

const Json& decided(const Json& schema, const Json& value)
{
    if (!schema.is_object() || !schema.contains("if"))
        return schema;
    const bool wantsArray = schema["if"]["type"] == "array";
    return schema[(wantsArray ? value.is_array() : value.is_object()) ? "then" : "else"];
}

const Json* schemaAt(const Json& schema, const Json& document, const Json::json_pointer& pointer)
{
    std::vector<std::string> tokens;
    for (auto rest = pointer; !rest.empty(); rest.pop_back())
        tokens.insert(tokens.begin(), rest.back());
    const Json absent;
    const Json* part = &schema;
    const Json* value = &document;
    for (const std::string& token : tokens) {
        part = childSchema(decided(*part, *value), token);
        if (!part)
            return nullptr;
        const Json::json_pointer step = Json::json_pointer() / token;
        value = value->is_structured() && value->contains(step) ? &value->at(step) : &absent;
    }
    return part;
}

size_t canonicalIndex(const Json& object, const std::string& key, const Json* schema)
{
    if (!schema || !decided(*schema, object).contains("properties"))
        return object.size();
    const Json& properties = decided(*schema, object)["properties"];
    const size_t place = placeIn(properties, key);
    size_t index = 0;
    for (auto it = object.begin(); it != object.end(); ++it, ++index)
        if (properties.contains(it.key()) && placeIn(properties, it.key()) > place)
            return index;
    return object.size();
}

} // namespace fx::editor
