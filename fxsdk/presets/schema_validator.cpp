#include "fxsdk/presets/schema_validator.h"

#include "fxsdk/presets/json_sax.h"
#include "fxsdk/presets/schema_explainer.h"

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include <set>

namespace fx::preset {

namespace {

using Json = nlohmann::json;
using Adapter = valijson::adapters::NlohmannJsonAdapter;

/// valijson names places as {"<root>", "[member]", "[3]"}.
std::string toPointer(const std::vector<std::string>& context)
{
    std::string pointer;
    for (size_t i = 1; i < context.size(); ++i)
        pointer.append("/").append(
            escapePointer(std::string_view(context[i]).substr(1, context[i].size() - 2)));
    return pointer;
}

/// Pointers of all objections with the first description of each, sorted so that inner places follow outer
/// ones.
std::map<std::string, std::string> objections(const valijson::ValidationResults& results)
{
    std::map<std::string, std::string> places;
    for (const valijson::ValidationResults::Error& error : results)
        places.emplace(toPointer(error.context), error.description);
    return places;
}

/// True when an inner place of `pointer` is among the objections: this one only repeats that its member
/// failed.
bool hasInner(const std::map<std::string, std::string>& places, const std::string& pointer)
{
    const auto next = places.lower_bound(pointer + "/");
    return next != places.end() && next->first.starts_with(pointer + "/");
}

} // namespace

/// A schema in both forms: as text for explaining, as valijson's for judging.
struct SchemaValidator::Part
{
    explicit Part(Json schema) : text(std::move(schema))
    {
        valijson::SchemaParser parser;
        const Adapter adapter(text);
        parser.populateSchema(adapter, compiled);
    }

    Json text;
    valijson::Schema compiled;
};

SchemaValidator::SchemaValidator(nlohmann::json schema) : root_(std::make_unique<Part>(std::move(schema))) {}
SchemaValidator::~SchemaValidator() = default;

void SchemaValidator::validatePart(const Part& part, const nlohmann::json& value, const std::string& pointer,
                                   Findings& findings) const
{
    valijson::ValidationResults results;
    valijson::Validator validator;
    const Adapter adapter(value);
    if (validator.validate(part.compiled, adapter, &results))
        return;
    const std::map<std::string, std::string> places = objections(results);
    for (const auto& [place, description] : places) {
        if (findings.full())
            return;
        const Json::json_pointer inner(place);
        const Json* const schema = schemaAt(part.text, value, inner);
        const size_t explained = schema ? explain(*schema, value[inner], pointer + place, findings) : 0;
        if (explained == 0 && !hasInner(places, place))
            findings.error(pointer + place, description);
    }
}

void SchemaValidator::validate(nlohmann::json& document, std::span<const std::string_view> longArrays,
                               Findings& findings) const
{
    std::vector<std::pair<Json::json_pointer, Json>> taken;
    for (const std::string_view name : longArrays) {
        const Json::json_pointer pointer{std::string(name)};
        if (!document.contains(pointer) || !document[pointer].is_array())
            continue;
        taken.emplace_back(pointer, Json::array());
        taken.back().second.swap(document[pointer]);
    }
    validatePart(*root_, document, "", findings);
    for (auto& [pointer, array] : taken) {
        if (const Json* const schema = schemaAt(root_->text, document, pointer)) {
            const Part element((*schema)["items"]);
            for (size_t i = 0; i < array.size() && !findings.full(); ++i)
                validatePart(element, array[i], pointer.to_string() + "/" + std::to_string(i), findings);
        }
        document[pointer].swap(array);
    }
}

} // namespace fx::preset
