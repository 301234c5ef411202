#include "fxsdk/presets/schema_assembly.h"

#include "embedded/preset_schemas.h"
namespace fx::preset {

namespace {

using Schema = nlohmann::ordered_json;

Schema textNamed(std::string_view name)
{
    for (const base::EmbeddedText& entry : embedded::texts())
        if (entry.name == name)
            return Schema::parse(entry.text.begin(), entry.text.end());
    return Schema::object();
}

/// {"type": "number"} with the bounds that stand beside the kind.
Schema numberWithin(const Schema& bounds)
{
    Schema number{{"type", "number"}};
    for (const char* key : {"minimum", "maximum"})
        if (bounds.contains(key))
            number[key] = bounds[key];
    return number;
}

Schema tripleOf(const Schema& number)
{
    return {{"type", "array"}, {"items", number}, {"minItems", 3}, {"maxItems", 3}};
}

Schema objectOf(Schema properties, Schema required)
{
    return {{"type", "object"},
            {"properties", std::move(properties)},
            {"required", std::move(required)},
            {"additionalProperties", false}};
}

/// {"keys": [[t, value], ...]}
Schema keysOf(const Schema& value)
{
    const Schema time{{"type", "number"}, {"minimum", 0}, {"maximum", 1}};
    const Schema key{
        {"type", "array"}, {"items", Schema::array({time, value})}, {"minItems", 2}, {"maxItems", 2}};
    const Schema keys{{"type", "array"}, {"items", key}, {"minItems", 1}, {"maxItems", 256}};
    return objectOf({{"keys", keys}}, {"keys"});
}

/// {"steps": [[time, value], ...]}
Schema stepsOf(const Schema& value)
{
    const Schema time{{"type", "number"}, {"minimum", 0}, {"maximum", 86400}};
    const Schema step{
        {"type", "array"}, {"items", Schema::array({time, value})}, {"minItems", 2}, {"maxItems", 2}};
    const Schema steps{{"type", "array"}, {"items", step}, {"minItems", 1}, {"maxItems", 1024}};
    return objectOf({{"steps", steps}}, {"steps"});
}

/// `then` for values of type `type`, otherwise `otherwise`.
Schema choice(const char* type, Schema then, Schema otherwise)
{
    return {{"if", {{"type", type}}}, {"then", std::move(then)}, {"else", std::move(otherwise)}};
}

Schema expandKind(const std::string& kind, const Schema& number)
{
    if (kind == "range")
        return choice("object", objectOf({{"min", number}, {"max", number}}, {"min", "max"}), number);
    if (kind == "curve")
        return choice("object", keysOf(number), number);
    if (kind == "colorCurve")
        return choice("object", keysOf(tripleOf(number)), tripleOf(number));
    if (kind == "extent")
        return choice("array", tripleOf(number), number);
    if (kind == "steps" || kind == "switches")
        return choice("object", stepsOf(number), number);
    return tripleOf(number); // color, vector
}

/// Replaces the kinds and the parts that techniques share in `schema` and everything below it.
void expand(Schema& schema)
{
    if (!schema.is_structured())
        return;
    if (schema.is_object() && schema.contains("x-part"))
        schema = textNamed(schema["x-part"].get<std::string>());
    for (Schema& part : schema)
        expand(part);
    if (!schema.is_object() || !schema.contains("x-kind"))
        return;
    const bool isSwitch = schema["x-kind"] == "switches";
    const Schema number = isSwitch ? Schema{{"type", "boolean"}} : numberWithin(schema);
    schema.erase("minimum");
    schema.erase("maximum");
    schema.update(expandKind(schema["x-kind"].get<std::string>(), number));
    schema["x-number"] = number;
}

/// A preview has the parts of a scene that show one effect; the effect itself is known.
void addPreview(Schema& preset)
{
    const Schema scene = textNamed("scene.schema.json");
    Schema& preview = preset["properties"]["preview"]["properties"];
    for (const char* part : {"camera", "exposureEv100", "lighting", "background", "mesh"})
        preview[part] = scene["properties"][part];
    Schema instance = scene["properties"]["instances"]["items"];
    instance["description"] = "Where the effect is, and when it begins.";
    instance.erase("required");
    instance["properties"].erase("preset");
    preview["instance"] = std::move(instance);
}

} // namespace

nlohmann::ordered_json presetSchema(Techniques techniques)
{
    Schema schema = textNamed("effect.schema.json");
    addPreview(schema);
    for (const Technique& technique : techniques) {
        const std::string_view text = technique.schema();
        const Schema element = Schema::parse(text.begin(), text.end());
        schema["properties"][std::string(technique.presetMember)] = {{"title", element["title"]},
                                                                     {"description", element["description"]},
                                                                     {"type", "array"},
                                                                     {"maxItems", 64},
                                                                     {"items", element}};
    }
    expand(schema);
    return schema;
}

nlohmann::ordered_json sceneSchema()
{
    Schema schema = textNamed("scene.schema.json");
    expand(schema);
    return schema;
}

} // namespace fx::preset
